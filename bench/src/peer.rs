//! Other programs that take turns with us.
//!
//! A peer makes itself ready, says `ready`, and then does its work once for every line it is sent, answering with the
//! seconds that it took by its own clock: what starting it costs is not counted.

use std::io::{BufRead, BufReader, Write};
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use anyhow::{Context, Error, Result, anyhow};
use clap::Args;
use goalgraph::dbscan::DbscanParameters;
use goalgraph::points::Points;

/// Points in a file of little-endian numbers of 64 bits, and what to cluster them with.
#[derive(Args)]
pub(crate) struct PointFile {
    pub(crate) file: PathBuf,
    pub(crate) dimension: usize,
    pub(crate) epsilon: f64,
    pub(crate) min_points: usize,
}

impl PointFile {
    /// Writes `points` into `folder`.
    pub(crate) fn write(folder: &Path, points: &Points, parameters: DbscanParameters) -> Result<Self> {
        let file = folder.join("points.f64");
        let bytes: Vec<u8> = points.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
        std::fs::write(&file, bytes)?;
        let DbscanParameters { epsilon, min_points } = parameters;
        Ok(Self { file, dimension: points.dimension(), epsilon, min_points })
    }

    /// The arguments that give it to a peer.
    pub(crate) fn arguments(&self) -> [String; 4] {
        let Self { file, dimension, epsilon, min_points } = self;
        [file.display().to_string(), dimension.to_string(), epsilon.to_string(), min_points.to_string()]
    }

    /// The coordinates in the file.
    #[cfg(feature = "peers")]
    pub(crate) fn read(&self) -> Result<Vec<f64>> {
        let bytes = std::fs::read(&self.file)?;
        let number = |bytes: &[u8]| bytes.try_into().map(f64::from_le_bytes);
        Ok(bytes.chunks_exact(8).map(number).collect::<Result<_, _>>()?)
    }
}

/// What keeps a peer from its work without being a fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub(crate) enum GivenUp {
    /// It took longer than [`LONGEST`].
    #[error("longer than {} minutes", LONGEST.as_secs() / 60)]
    TooLong,
    /// It needs more than [`MOST_MEMORY`].
    #[error("out of memory (limit {} GB)", MOST_MEMORY / 1_000_000_000)]
    OutOfMemory,
}

/// The longest turn of a peer, and the most memory it may ask for, in bytes.
const LONGEST: Duration = Duration::from_mins(3);
const MOST_MEMORY: u64 = 8_000_000_000;

/// The signal of a program that has aborted.
const ABORTED: i32 = 6;

/// A program at our side.
pub(crate) struct Peer {
    child: Child,
    orders: ChildStdin,
    answers: Receiver<String>,
}

impl Peer {
    /// Starts `command`, which may be bound in its memory, and waits until it is ready.
    ///
    /// # Errors
    ///
    /// When it cannot be started or does not become ready.
    pub(crate) fn start(command: &Command, is_bound: bool) -> Result<Self> {
        let mut bound = if is_bound { bound_in_memory(command) } else { copy(command) };
        bound.stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut child = bound.spawn().with_context(|| format!("cannot start {bound:?}"))?;
        let orders = child.stdin.take().context("a peer without standard input")?;
        let printed = child.stdout.take().context("a peer without standard output")?;
        let (send, answers) = channel();
        thread::spawn(move || {
            for line in BufReader::new(printed).lines().map_while(Result::ok) {
                if send.send(line).is_err() {
                    break;
                }
            }
        });
        let mut peer = Self { child, orders, answers };
        peer.answer()?;
        Ok(peer)
    }

    /// One turn; `order` says what to do where there is a choice. The seconds it took.
    ///
    /// # Errors
    ///
    /// [`GivenUp`], or what is wrong with the peer; it is of no use after either.
    pub(crate) fn turn(&mut self, order: &str) -> Result<f64> {
        if writeln!(self.orders, "{order}").is_err() {
            return Err(self.why_it_ended());
        }
        let answer = self.answer()?;
        if answer == "out of memory" {
            return Err(GivenUp::OutOfMemory.into());
        }
        answer.trim().parse().with_context(|| format!("a peer answered {answer:?} instead of seconds"))
    }

    fn answer(&mut self) -> Result<String> {
        self.answers.recv_timeout(LONGEST).map_err(|error| match error {
            RecvTimeoutError::Timeout => GivenUp::TooLong.into(),
            RecvTimeoutError::Disconnected => self.why_it_ended(),
        })
    }

    /// Rust aborts where there is no memory.
    fn why_it_ended(&mut self) -> Error {
        match self.child.wait() {
            Ok(status) if status.signal() == Some(ABORTED) => GivenUp::OutOfMemory.into(),
            Ok(status) => anyhow!("a peer ended: {status}"),
            Err(error) => error.into(),
        }
    }
}

impl Drop for Peer {
    /// Ends it: nothing of it is of use any longer.
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// The same command in a shell that may not use more than [`MOST_MEMORY`]: it can then not push others off the machine.
fn bound_in_memory(command: &Command) -> Command {
    let mut shell = Command::new("sh");
    shell.args(["-c", &format!("ulimit -v {}; exec \"$0\" \"$@\"", MOST_MEMORY / 1024)]);
    shell.arg(command.get_program()).args(command.get_args());
    with_surroundings(shell, command)
}

fn copy(command: &Command) -> Command {
    let mut same = Command::new(command.get_program());
    same.args(command.get_args());
    with_surroundings(same, command)
}

fn with_surroundings(mut to: Command, from: &Command) -> Command {
    for (name, value) in from.get_envs() {
        if let Some(value) = value {
            to.env(name, value);
        }
    }
    to
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shell(script: &str) -> Peer {
        Peer::start(Command::new("sh").args(["-c", script]), true).unwrap()
    }

    #[test]
    fn a_peer_answers_every_turn_with_its_seconds() {
        let mut peer = shell("echo ready; while read order; do echo $order; done");
        assert_eq!((peer.turn("1.5").unwrap(), peer.turn("2").unwrap()), (1.5, 2.0));
    }

    #[test]
    fn a_peer_without_memory_has_given_up() {
        for script in ["echo ready; read order; echo out of memory", "echo ready; read order; kill -ABRT $$"]
        {
            let error = shell(script).turn("run").unwrap_err();
            assert_eq!(error.downcast_ref(), Some(&GivenUp::OutOfMemory));
        }
    }

    #[test]
    fn a_peer_that_fails_is_no_result() {
        let error = shell("echo ready; exit 3").turn("run").unwrap_err();
        assert_eq!(error.to_string(), "a peer ended: exit status: 3");
    }
}
