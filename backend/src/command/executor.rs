//! `goalgraph executor`: a simulated robot at a server.

use std::path::PathBuf;

use clap::Args;
use goalgraph::protocol::executor::MAX_ID;
use goalgraph_server::executor::{Address, Begin, Disturbances, Session, Settings, Timed, run as run_robot};
use tokio::runtime::Runtime;

use crate::failure::Failure;
use crate::output;
use crate::stop::stop_signal;

/// Arguments of `goalgraph executor`.
#[derive(Args)]
pub(crate) struct Arguments {
    /// The server; /api/v1/executor is added where the URL has no path
    #[arg(long, value_name = "URL", default_value = "ws://127.0.0.1:7700")]
    url: String,
    /// Token of the role executor, for servers that ask for one
    #[arg(long, env = "GOALGRAPH_TOKEN", hide_env_values = true)]
    token: Option<String>,
    /// Authorities to believe instead of the public ones with wss, a PEM file
    #[arg(long, value_name = "FILE")]
    ca: Option<PathBuf>,
    /// Name of the robot, other than that of every other executor
    #[arg(long, default_value = "simulated")]
    name: String,
    /// Id of the specification to follow [default: the one that was approved last]
    #[arg(long, value_name = "ID")]
    specification: Option<String>,
    /// Sub-goals that cannot be completed, by id, name or beginning of the name
    #[arg(long, value_name = "G1,G2,..", value_delimiter = ',')]
    unavailable: Vec<String>,
    /// Sub-goals that cannot be completed any more so many seconds after a run has begun
    #[arg(long, value_name = "G1@SECONDS,..", value_delimiter = ',')]
    becomes_unavailable: Vec<Timed>,
    /// Sub-goals that can be completed again so many seconds after a run has begun
    #[arg(long, value_name = "G1@SECONDS,..", value_delimiter = ',')]
    available_again: Vec<Timed>,
    /// Sub-goals at which the robot fails and ends the run
    #[arg(long, value_name = "G1,G2,..", value_delimiter = ',')]
    fail: Vec<String>,
    /// How fast things move, in meters (or whatever the unit of the features is) a second
    #[arg(long, value_name = "M_PER_S", default_value_t = 0.1)]
    speed: f64,
    /// Begin so many runs without being told to, one after the other, then end
    #[arg(long, value_name = "N", conflicts_with_all = ["auto", "once"], value_parser = clap::value_parser!(u64).range(1..))]
    runs: Option<u64>,
    /// Begin a run with every specification that is approved, without being told to
    #[arg(long)]
    auto: bool,
    /// End after the first run
    #[arg(long)]
    once: bool,
}

/// Runs the robot until it is done or the program is told to stop (Ctrl+C or SIGTERM), and prints what happens.
///
/// # Errors
///
/// When an argument is none that a robot can have, or the server does not take the robot.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let settings = settings(arguments)?;
    let address = Address::new(&arguments.url, arguments.token.clone(), arguments.specification.as_deref())
        .map_err(|error| Failure::Usage(format!("error: --url {error}")))?;
    let address = match &arguments.ca {
        Some(file) => address.trusting(file).map_err(|error| Failure::input(error.to_string()))?,
        None => address,
    };
    let say = |line: &str| {
        // Without a standard output there is nobody to read it.
        let _ = output::print(&format!("{line}\n"));
    };
    let runtime = Runtime::new().map_err(|error| Failure::input(error.to_string()))?;
    runtime.block_on(async {
        let stop = stop_signal().map_err(|error| Failure::input(error.to_string()))?;
        let ended = run_robot(&address, Session::new(settings), say, stop).await;
        ended.map_err(|error| Failure::input(error.to_string()))
    })
}

fn settings(arguments: &Arguments) -> Result<Settings, Failure> {
    let usage = |message: String| Err(Failure::Usage(format!("error: {message}")));
    let Arguments { name, speed, .. } = arguments;
    let length = name.chars().count();
    if name.trim().is_empty() || length > MAX_ID || name.chars().any(char::is_control) {
        return usage(format!("--name: expected 1 to {MAX_ID} characters that can be read, not {name:?}"));
    }
    if !speed.is_finite() || *speed <= 0.0 {
        return usage(format!("--speed {speed}: expected a number above 0"));
    }
    Ok(Settings {
        name: name.clone(),
        begin: match arguments.runs {
            Some(runs) => Begin::Times(runs),
            None if arguments.auto => Begin::EverySpecification,
            None => Begin::OnCommand,
        },
        runs: arguments.runs.or(arguments.once.then_some(1)),
        speed: *speed,
        disturbances: Disturbances {
            unavailable: arguments.unavailable.clone(),
            lost: arguments.becomes_unavailable.clone(),
            regained: arguments.available_again.clone(),
            failing: arguments.fail.clone(),
        },
    })
}
