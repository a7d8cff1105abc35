//! Ground state: what nothing else could tell. Whatever follows from it is in [`super::derived`].

mod editing;
mod keeping;
mod looking;
mod tuning;
mod watching;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use goalgraph::edit;
use goalgraph::history::History;
use goalgraph::infer::{InferRequest, Method, Progress, RadiusRule};
use goalgraph::layout::Point;
use goalgraph::pdfa::{Semantics, StateId, Symbol, Word};
use goalgraph::plan::Strategy;
use goalgraph::subset::SubsetRequest;
use leptos::prelude::*;
use serde::Deserialize;

use super::theme::Theme;
use crate::protocol::{DemonstrationId, FileContent, FileId, Outcome, Track};

pub(crate) use editing::{Draft, Gesture, Menu, MenuContent, Selection};
pub(crate) use keeping::{
    Compared, KeepDialog, Keeping, Kept, Lineage, Loading, Onto, Queued, Server, Signing,
};
pub(crate) use looking::{Search, Side, Simulation, TextPane, Tidied};
pub(crate) use tuning::{Attempt, Curve, CurveOf, Found, Tuning, UnderWay};
pub(crate) use watching::{
    Connection, EventFilter, EventKind, EventLog, Heard, Replay, RunMode, SeenExecutor, Watching,
};

/// What a task is called until somebody names it; the command line's default is the same.
pub(crate) const UNTITLED: &str = "Untitled task";

/// The tabs, in the order of the flow.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Tab {
    /// Files and what is in them.
    #[default]
    Demonstrations,
    /// What was found in each feature subset.
    SubGoals,
    /// The graph.
    Automaton,
    /// Plan and availability.
    Run,
}

impl Tab {
    /// All tabs, from left to right.
    pub(crate) const ALL: [Self; 4] = [Self::Demonstrations, Self::SubGoals, Self::Automaton, Self::Run];

    /// The name on the tab.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Demonstrations => "Demonstrations",
            Self::SubGoals => "Sub-goals",
            Self::Automaton => "Automaton",
            Self::Run => "Run",
        }
    }
}

/// A file that somebody gave.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct LoadedFile {
    /// Its identity here and in the worker.
    pub(crate) id: FileId,
    /// What it is called.
    pub(crate) name: String,
    /// How many bytes it has.
    pub(crate) bytes: f64,
    /// How far the reading is.
    pub(crate) reading: Reading,
}

/// How far the reading of a file is.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Reading {
    /// The worker has it before it.
    Waiting,
    /// Somebody canceled before it was read.
    Canceled,
    /// It is read.
    Read(Arc<FileContent>),
    /// It holds no demonstrations, for this reason.
    Refused(String),
}

/// What the expert chose for the inference; the rest of the request is the files and the name.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Settings {
    /// The subsets, or none for the engine's proposal.
    pub(crate) subsets: Option<Vec<SubsetRequest>>,
    /// Which frames are clustered.
    pub(crate) method: Method,
    /// How large balls are.
    pub(crate) radius: RadiusRule,
}

/// What an inference is made from: the same basis gives the same outcome.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Basis {
    /// The files, in order.
    pub(crate) files: Vec<FileId>,
    /// The request.
    pub(crate) request: InferRequest,
}

/// An outcome and what it was made from.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Learned {
    /// What it was made from.
    pub(crate) basis: Basis,
    /// What came out.
    pub(crate) outcome: Arc<Outcome>,
}

/// What the worker infers at the moment.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Inferring {
    /// What the outcome is to be made from.
    pub(crate) basis: Basis,
    /// How far it is.
    pub(crate) progress: Progress,
    /// Whether it still infers from an earlier basis, whose outcome nobody waits for any more.
    pub(crate) superseded: bool,
}

/// What lies over the page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Overlay {
    /// All commands, to search and run.
    Palette,
    /// All commands, to read.
    Help,
    /// How long an edit takes.
    Benchmark,
    /// Something about what the server keeps.
    Keep(KeepDialog),
}

/// A sentence about what just happened.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Notice {
    /// The sentence.
    pub(crate) text: String,
    /// Whether something went wrong.
    pub(crate) alarming: bool,
}

/// A set of demonstrations that comes with the app.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub(crate) struct Sample {
    /// Its folder.
    pub(crate) id: String,
    /// Its name.
    pub(crate) title: String,
    /// What it shows.
    pub(crate) description: String,
    /// Its files.
    pub(crate) files: Vec<String>,
}

/// How the drawing lies in its frame: `on_screen = on_drawing * scale + (x, y)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Viewport {
    /// Pixels of the screen per pixel of the drawing.
    pub(crate) scale: f64,
    /// Where the drawing's left edge is.
    pub(crate) x: f64,
    /// Where the drawing's top edge is.
    pub(crate) y: f64,
}

/// All ground state.
pub(crate) struct Model {
    /// The files, in the order in which they came.
    pub(crate) files: RwSignal<Vec<LoadedFile>>,
    /// What the task is called.
    pub(crate) task_name: RwSignal<String>,
    /// What the expert chose.
    pub(crate) settings: RwSignal<Settings>,
    /// How weights are to be read in what is learned next.
    pub(crate) semantics: RwSignal<Semantics>,
    /// The specification with everything that was done to it; none before the first was learned or opened.
    pub(crate) history: RwSignal<Option<History>>,
    /// The edit that is thought of.
    pub(crate) draft: RwSignal<Option<Draft>>,
    /// Pairs of states that are not to be proposed for a merge again.
    pub(crate) vetoed: RwSignal<BTreeSet<(StateId, StateId)>>,
    /// What keeps its share while others are reweighted.
    pub(crate) locked: RwSignal<BTreeSet<(StateId, edit::Outcome)>>,
    /// What was learned last.
    pub(crate) learned: RwSignal<Option<Learned>>,
    /// What is being learned.
    pub(crate) inferring: RwSignal<Option<Inferring>>,
    /// What somebody canceled to learn from, so that it is not begun again unasked.
    pub(crate) canceled: RwSignal<Option<Basis>>,
    /// Where the worker places everything when nothing is held.
    pub(crate) tidied: RwSignal<Tidied>,
    /// States that somebody has put somewhere, in the drawing space.
    pub(crate) held: RwSignal<BTreeMap<StateId, Point>>,
    /// States that are being dragged, in the drawing space.
    pub(crate) moving: RwSignal<BTreeMap<StateId, Point>>,
    /// The demonstration on display.
    pub(crate) demonstration: RwSignal<Option<DemonstrationId>>,
    /// Its values, once the worker gave them.
    pub(crate) track: RwSignal<Option<(DemonstrationId, Arc<Track>)>>,
    /// The frame of it that is pointed out.
    pub(crate) moment: RwSignal<Option<usize>>,
    /// The subset on display.
    pub(crate) subset: RwSignal<usize>,
    /// Another epsilon for it.
    pub(crate) tuning: Tuning,
    /// The tab on display.
    pub(crate) tab: RwSignal<Tab>,
    /// What is selected in the automaton, in the order in which it was; the last is what the inspector shows.
    pub(crate) selection: RwSignal<Vec<Selection>>,
    /// The words whose ways are lit up.
    pub(crate) lit: RwSignal<BTreeSet<Word>>,
    /// Transitions less probable than this are hidden from view.
    pub(crate) hidden_below: RwSignal<f64>,
    /// The list beside the graph.
    pub(crate) side: RwSignal<Side>,
    /// The text beside the graph.
    pub(crate) text_pane: RwSignal<Option<TextPane>>,
    /// What is looked for.
    pub(crate) search: RwSignal<Search>,
    /// The walk through the automaton.
    pub(crate) simulation: RwSignal<Simulation>,
    /// What a pointer is doing in the drawing.
    pub(crate) gesture: RwSignal<Option<Gesture>>,
    /// The menu that is open.
    pub(crate) menu: RwSignal<Option<Menu>>,
    /// How the drawing lies; none until it was fitted.
    pub(crate) viewport: RwSignal<Option<Viewport>>,
    /// Whether nobody has moved or zoomed the drawing since it was fitted.
    pub(crate) fitted: RwSignal<bool>,
    /// Width and height of the drawing's frame.
    pub(crate) frame: RwSignal<(f64, f64)>,
    /// Whether the automaton is shown as a table.
    pub(crate) as_table: RwSignal<bool>,
    /// Sub-goals that cannot be completed now.
    pub(crate) unavailable: RwSignal<BTreeSet<Symbol>>,
    /// How plans are chosen.
    pub(crate) strategy: RwSignal<Strategy>,
    /// What lies over the page.
    pub(crate) overlay: RwSignal<Option<Overlay>>,
    /// Whether files are being dragged over the page.
    pub(crate) dragging: RwSignal<bool>,
    /// The last sentence to the user.
    pub(crate) notice: RwSignal<Notice>,
    /// Samples that the server offers; none until it answered.
    pub(crate) samples: RwSignal<Option<Vec<Sample>>>,
    /// Whether there is something that was cleared and can be brought back.
    pub(crate) can_bring_back: RwSignal<bool>,
    /// Whether the browser refuses to keep the work.
    pub(crate) unkept: RwSignal<bool>,
    /// Names of earlier work that cannot be read.
    pub(crate) aside: RwSignal<Vec<String>>,
    /// What the server keeps of it.
    pub(crate) keeping: Keeping,
    /// Executors and runs.
    pub(crate) watching: Watching,
    /// The colors of the page.
    pub(crate) theme: RwSignal<Theme>,
}

impl Model {
    /// An empty app.
    pub(crate) fn new() -> Self {
        Self {
            files: RwSignal::default(),
            task_name: RwSignal::new(UNTITLED.to_owned()),
            settings: RwSignal::default(),
            semantics: RwSignal::default(),
            history: RwSignal::default(),
            draft: RwSignal::default(),
            vetoed: RwSignal::default(),
            locked: RwSignal::default(),
            learned: RwSignal::default(),
            inferring: RwSignal::default(),
            canceled: RwSignal::default(),
            tidied: RwSignal::default(),
            held: RwSignal::default(),
            moving: RwSignal::default(),
            demonstration: RwSignal::default(),
            track: RwSignal::default(),
            moment: RwSignal::default(),
            subset: RwSignal::default(),
            tuning: Tuning::default(),
            tab: RwSignal::default(),
            selection: RwSignal::default(),
            lit: RwSignal::default(),
            hidden_below: RwSignal::default(),
            side: RwSignal::default(),
            text_pane: RwSignal::default(),
            search: RwSignal::default(),
            simulation: RwSignal::default(),
            gesture: RwSignal::default(),
            menu: RwSignal::default(),
            viewport: RwSignal::default(),
            fitted: RwSignal::default(),
            frame: RwSignal::default(),
            as_table: RwSignal::default(),
            unavailable: RwSignal::default(),
            strategy: RwSignal::default(),
            overlay: RwSignal::default(),
            dragging: RwSignal::default(),
            notice: RwSignal::default(),
            samples: RwSignal::default(),
            can_bring_back: RwSignal::default(),
            unkept: RwSignal::default(),
            aside: RwSignal::default(),
            keeping: Keeping::default(),
            watching: Watching::new(),
            theme: RwSignal::new(Theme::stored()),
        }
    }
}
