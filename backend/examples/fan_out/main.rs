//! How long an approval takes to reach every executor, beside what the same bytes take through a bare loop over
//! tokio-tungstenite sockets: `cargo run --example fan_out -p goalgraph-server [--release] [EXECUTORS] [ROUNDS]`.
//!
//! Both serve clients of the same kind in the same process over loopback, one after the other in each round. The relay's
//! time begins when it is told of the approval and includes reading and checking the revision from its database; the
//! bare loop has the bytes at hand.

mod bare;
mod clients;
mod relayed;

use std::process::ExitCode;
use std::time::Duration;

use anyhow::{Context, Result, ensure};

/// Sockets have two ends, both in this process, for each of the two servers; some files beside.
const FILES_PER_EXECUTOR: u64 = 4;
const FILES_BESIDE: u64 = 100;

#[tokio::main]
async fn main() -> ExitCode {
    match measure().await {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error:#}");
            ExitCode::FAILURE
        }
    }
}

async fn measure() -> Result<()> {
    let mut arguments = std::env::args().skip(1);
    let mut number = |default: usize| -> Result<usize> {
        let given =
            arguments.next().map(|text| text.parse().with_context(|| format!("{text:?} is no number")));
        given.unwrap_or(Ok(default))
    };
    let (executors, rounds) = (number(1000)?, number(15)?);
    ensure!(executors > 0 && rounds > 0, "expected at least one executor and one round");
    ensure_files(executors as u64)?;

    let mut relayed = relayed::Relayed::begin(executors).await?;
    let mut bare = bare::Bare::begin(executors).await?;
    let (mut relay_times, mut reading_times, mut bare_times, mut ratios) = (vec![], vec![], vec![], vec![]);
    let mut bytes = 0;
    for round in 0..=rounds {
        let (message, times) = relayed.approve().await?;
        bytes = message.len();
        let bare_time = bare.send(&message).await?;
        // The first round warms up.
        if round > 0 {
            ratios.push(times.all.as_secs_f64() / bare_time.as_secs_f64());
            relay_times.push(times.all);
            reading_times.push(times.reading);
            bare_times.push(bare_time);
        }
    }
    let profile = if cfg!(debug_assertions) { "dev" } else { "release" };
    println!(
        "{executors} executors, a message of {bytes} bytes, {rounds} rounds, {profile} profile; medians:"
    );
    println!("approval to the last executor, through the relay: {:.1} ms", milliseconds(&mut relay_times));
    println!("  of it until the message was read and written:   {:.1} ms", milliseconds(&mut reading_times));
    println!("the same bytes through a bare loop:               {:.1} ms", milliseconds(&mut bare_times));
    ratios.sort_by(f64::total_cmp);
    let (low, high) = (ratios[0], ratios[ratios.len() - 1]);
    println!("ratio of a round: {:.2} (from {low:.2} to {high:.2})", ratios[ratios.len() / 2]);
    Ok(())
}

fn milliseconds(times: &mut [Duration]) -> f64 {
    times.sort();
    times[times.len() / 2].as_secs_f64() * 1000.0
}

/// Refuses to begin what would end in the middle for want of file descriptors.
fn ensure_files(executors: u64) -> Result<()> {
    let needed = executors * FILES_PER_EXECUTOR + FILES_BESIDE;
    let Ok(limits) = std::fs::read_to_string("/proc/self/limits") else { return Ok(()) };
    let line = limits.lines().find(|line| line.starts_with("Max open files"));
    let soft = line.and_then(|line| line.split_whitespace().nth(3)).and_then(|soft| soft.parse::<u64>().ok());
    let soft = soft.unwrap_or(u64::MAX);
    ensure!(
        soft >= needed,
        "{executors} executors need {needed} open files, but this shell allows {soft}; raise it with `ulimit -n {needed}`"
    );
    Ok(())
}
