//! `goalgraph plan`: the order of sub-goals that a robot should follow.

use std::collections::BTreeSet;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use goalgraph::pdfa::{StateId, Symbol};
use goalgraph::plan::{NoPlan, Plan, PlanRequest, Strategy, plan};
use goalgraph::specification::Specification;
use goalgraph_server::alphabet;
use serde::Serialize;

use crate::failure::Failure;
use crate::{input, output};

/// Arguments of `goalgraph plan`.
#[derive(Args)]
pub(crate) struct Arguments {
    /// The specification; - is standard input
    #[arg(value_name = "SPEC")]
    specification: PathBuf,
    /// Sub-goals that cannot be completed now, by id, name or beginning of the name; repeatable
    #[arg(long, value_name = "G1,G2,..", value_delimiter = ',')]
    unavailable: Vec<String>,
    /// The state to start from [default: the initial state]
    #[arg(long, value_name = "STATE")]
    from: Option<StateId>,
    /// How the order is chosen
    #[arg(long, value_enum, default_value_t)]
    strategy: StrategyName,
    /// Print the plan as JSON
    #[arg(long)]
    json: bool,
}

/// Value of `--strategy`.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
enum StrategyName {
    /// At each state the most probable way that is available
    #[default]
    Greedy,
    /// The most probable order as a whole
    MostProbable,
}

/// Prints the plan; when there is none, what can be done meanwhile.
///
/// # Errors
///
/// When the specification cannot be read, a sub-goal or state is not in it, or nothing can be done at all.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let specification = input::read_specification(&arguments.specification)?;
    let request = request(arguments, &specification)?;
    let probabilities = specification.pdfa.probabilities(specification.semantics);
    match plan(&specification.pdfa, &probabilities, &request) {
        Ok(plan) => print(arguments, &specification, &plan, true),
        Err(NoPlan::OutOfReach { meanwhile, .. }) if !meanwhile.word.is_empty() => {
            output::say(&warning(&specification, &request, &meanwhile));
            print(arguments, &specification, &meanwhile, false)
        }
        Err(error) => Err(Failure::input(error.to_string())),
    }
}

fn request(arguments: &Arguments, specification: &Specification) -> Result<PlanRequest, Failure> {
    let found = |text: &String| alphabet::find(specification, text.trim());
    let unavailable: Result<BTreeSet<Symbol>, String> = arguments.unavailable.iter().map(found).collect();
    let unavailable = unavailable.map_err(|message| Failure::input(format!("--unavailable: {message}")))?;
    let from = arguments.from.unwrap_or(specification.pdfa.initial);
    let strategy = match arguments.strategy {
        StrategyName::Greedy => Strategy::Greedy,
        StrategyName::MostProbable => Strategy::MostProbable,
    };
    Ok(PlanRequest { from, unavailable, strategy })
}

/// Why the order is not complete, in one sentence.
fn warning(specification: &Specification, request: &PlanRequest, meanwhile: &Plan) -> String {
    let missing: Vec<String> =
        request.unavailable.iter().map(|&symbol| specification.name_of(symbol)).collect();
    let probabilities = specification.pdfa.probabilities(specification.semantics);
    let last = meanwhile.states.last().copied().unwrap_or(request.from);
    let later = PlanRequest { from: last, unavailable: BTreeSet::new(), ..request.clone() };
    let rest = plan(&specification.pdfa, &probabilities, &later).map_or(0, |rest| rest.word.len());
    let (done, all) = (meanwhile.word.len(), meanwhile.word.len() + rest);
    format!(
        "no plan reaches an accepting state without {}; this order goes as far as possible ({done} of {all} sub-goals) and then waits",
        output::list(&missing)
    )
}

/// What `goalgraph plan --json` prints.
#[derive(Serialize)]
struct PlanReport<'a> {
    complete: bool,
    word: &'a [Symbol],
    names: Vec<String>,
    states: &'a [StateId],
    probability: f64,
}

fn print(
    arguments: &Arguments,
    specification: &Specification,
    plan: &Plan,
    complete: bool,
) -> Result<(), Failure> {
    let names: Vec<String> = plan.word.iter().map(|&symbol| specification.name_of(symbol)).collect();
    if arguments.json {
        let (word, states, probability) = (&plan.word[..], &plan.states[..], plan.probability);
        return output::print_json(&PlanReport { complete, word, names, states, probability });
    }
    let line = |(symbol, name): (&Symbol, &String)| format!("{symbol}  {name}");
    let mut lines: Vec<String> = plan.word.iter().zip(&names).map(line).collect();
    lines.push(plan.probability.to_string());
    output::print(&(lines.join("\n") + "\n"))
}
