//! What a person can ask of the app.

use std::collections::BTreeMap;

use goalgraph::edit::{Edit, Outcome};
use goalgraph::export::ExportFormat;
use goalgraph::infer::{Method, RadiusRule};
use goalgraph::layout::Point;
use goalgraph::pdfa::{Semantics, StateId, Symbol, Word};
use goalgraph::plan::Strategy;
use goalgraph::subset::SubsetRequest;
use web_sys::File;

use super::keeping::KeepAction;
use super::select::Flow;
use super::tuning::Tune;
use super::watch::WatchAction;
use crate::page::model::{Menu, Notice, Overlay, Sample, Selection, Side, Tab, TextPane};
use crate::protocol::{DemonstrationId, FileId};

/// What a gesture means.
#[derive(Clone, Debug)]
pub(crate) enum Action {
    /// Take these files.
    Open(Vec<(String, File)>),
    /// Let go of a file.
    Remove(FileId),
    /// Read a file whose reading was canceled.
    ReadAgain(FileId),
    /// Load a sample that comes with the app.
    LoadSample(Sample),
    /// Let go of everything.
    Clear,
    /// Bring back what was let go of last.
    BringBack,
    /// Infer from what is there.
    Infer,
    /// Stop what the worker does.
    Cancel,
    /// Name the task.
    Name(String),
    /// Search other subsets; none for the engine's proposal.
    ChooseSubsets(Option<Vec<SubsetRequest>>),
    /// Take an eliminated cluster for a sub-goal all the same.
    Restore {
        /// Name of its subset.
        subset: String,
        /// Its center.
        center: Vec<f64>,
    },
    /// Cluster other frames.
    ChooseMethod(Method),
    /// Size balls in another way.
    ChooseRadius(RadiusRule),
    /// Read weights in another way.
    ChooseSemantics(Semantics),
    /// Choose plans in another way.
    ChooseStrategy(Strategy),
    /// Show a demonstration.
    Show(DemonstrationId),
    /// Show the demonstration at this position of the specification, at a frame.
    ShowNamed(usize, Option<usize>),
    /// Show a subset.
    ShowSubset(usize),
    /// Try or choose other parameters for the subset on display.
    Tune(Tune),
    /// Show a tab.
    GoTo(Tab),
    /// Select in the automaton, alone.
    Select(Option<Selection>),
    /// Select more, or less.
    ToggleSelected(Selection),
    /// Select all of these.
    SelectAll(Vec<Selection>),
    /// Select what leads to the selected states, or what they lead to.
    SelectFlow(Flow),
    /// Show what these edits would do, while a pointer or the focus rests on them.
    Consider(Vec<Edit>),
    /// Stop showing it.
    ConsiderNoMore,
    /// Begin these edits: show what they would do, and wait for an answer.
    Begin(Vec<Edit>),
    /// Make the edits that were begun.
    Apply,
    /// Forget them.
    CancelDraft,
    /// Make these edits at once, under this name or that of the first.
    Edit(Option<String>, Vec<Edit>),
    /// Undo the last transaction.
    Undo,
    /// Make it again.
    Redo,
    /// Mark the present place in the history as approved.
    MarkApproved,
    /// Go to this place in the history.
    Jump(usize),
    /// Do not propose this merge again.
    Veto(StateId, StateId),
    /// Let an outcome keep its share while others are reweighted, or not.
    Lock(StateId, Outcome, bool),
    /// Put states somewhere while they are dragged; with none the drag is over and nothing came of it.
    Move(BTreeMap<StateId, Point>),
    /// Let the dragged states stay where they are.
    Drop,
    /// Let states go to where the layout puts them.
    Unpin(Vec<StateId>),
    /// Place everything anew.
    Tidy,
    /// Light up the way of a word, or let it go out.
    Light(Word),
    /// Hide transitions that are less probable from view.
    HideBelow(f64),
    /// Show a list beside the graph.
    ShowSide(Side),
    /// Show a text beside the graph.
    ShowText(Option<TextPane>),
    /// Look for something.
    Search(Option<String>),
    /// Go to the next hit, or by a negative number to an earlier one.
    NextHit(isize),
    /// Show a menu.
    Menu(Option<Menu>),
    /// Break off what the pointer does.
    Abort,
    /// Begin or end a walk.
    Walk(bool),
    /// Complete a sub-goal on the walk.
    Step(Symbol),
    /// Go back to after so many steps.
    StepBack(usize),
    /// Draw words from another seed.
    Seed(u64),
    /// Show the automaton as a table or as a graph.
    ToggleTable,
    /// Say that a sub-goal is available, or not.
    SetAvailable(Symbol, bool),
    /// Do something with what the server keeps.
    Keep(KeepAction),
    /// Lay something over the page, or take it away.
    Overlay(Option<Overlay>),
    /// Change between light and dark.
    ToggleTheme,
    /// Save the specification.
    Export(ExportFormat),
    /// Watch executors and runs.
    Watch(WatchAction),
    /// Say a sentence.
    Say(Notice),
}

impl Action {
    /// Whether it changes the automaton, or is about to.
    pub(super) fn is_edit(&self) -> bool {
        matches!(
            self,
            Self::Begin(_) | Self::Apply | Self::Edit(..) | Self::Undo | Self::Redo | Self::Jump(_)
        )
    }
}
