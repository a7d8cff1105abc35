//! A small task done once before anybody waits: browsers compile a function when it is first called. No browser here.

use std::fmt::Write;

use goalgraph::infer::InferRequest;

use super::reading::read;
use super::recordings::Recordings;
use crate::protocol::{FileId, FromWorker, ToWorker, decode, encode};

/// Does what is done between a drop and a drawn graph; gives what would have been said.
pub(super) fn warm_up() -> Vec<FromWorker> {
    let mut recordings = Recordings::default();
    let files = [FileId(0), FileId(1)];
    let mut said: Vec<FromWorker> = files
        .iter()
        .map(|&file| recordings.keep(file, read("warm-up.csv", carried().as_bytes(), None)))
        .collect();
    let request = encode(&ToWorker::Infer { files: files.into(), request: InferRequest::default() });
    if let Ok(request) = decode(&request) {
        recordings.serve(request, &mut |message| said.push(message));
    }
    said
}

/// A recording in which two things are carried to a place in space, one after the other.
fn carried() -> String {
    let mut table = String::from("a.x,a.y,a.z,b.x,b.y,b.z\n");
    for frame in 0..120_i32 {
        let at = |begin: i32| f64::from((frame - begin).clamp(0, 20)) / 20.0;
        let shake = f64::from(frame * 7 % 5) / 1000.0;
        // Writing to a string does not fail.
        let _ =
            writeln!(table, "{:.4},{shake:.4},0.02,{shake:.4},{:.4},0.02", at(20) + shake, at(70) + shake);
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everything_is_done_once() {
        let said = warm_up();
        let Some(FromWorker::Inferred { result: Ok(outcome), layouts }) = said.last() else {
            panic!("{said:?}")
        };
        assert_eq!(outcome.completed[0].word.len(), 2);
        assert_eq!(layouts[0].nodes.len(), 3);
    }
}
