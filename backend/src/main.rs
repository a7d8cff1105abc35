//! `goalgraph`: Goalgraph on the command line.
//!
//! Exit status: 0 done; 1 the input is wrong, said in one line per fault on standard error; 2 wrong usage. Results go to
//! standard output, everything said about them to standard error. Nothing is written when anything is wrong.
//!
//! Modules in reading order: [`command`] has one module per command; [`input`] reads files, [`output`] writes them;
//! [`progress`] tells what takes long; [`stop`] how the program ends; [`failure`] is how a command fails.

#![cfg_attr(test, allow(clippy::unwrap_used))]

mod command;
mod failure;
mod input;
mod output;
mod progress;
mod stop;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

use command::{backup, check, executor, export, infer, plan, schema, serve, token, verify};

/// Recorded demonstrations in, a probabilistic automaton of the task out.
#[derive(Parser)]
#[command(name = "goalgraph", version, max_term_width = 110, arg_required_else_help = true)]
struct CommandLine {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Infers a specification from demonstrations, or from words
    Infer(infer::Arguments),
    /// Prints the order of sub-goals that a robot should follow, one per line, then its probability
    Plan(plan::Arguments),
    /// Lists what is wrong with a specification, and which demonstrations it accepts
    Check(check::Arguments),
    /// Writes a specification in the format of another tool
    Export(export::Arguments),
    /// Simulates a robot that follows the approved specification of a server
    Executor(executor::Arguments),
    /// Prints the JSON Schema of a format
    Schema(schema::Arguments),
    /// Serves the app to browsers on this computer
    Serve(serve::Arguments),
    /// Makes, lists and revokes the tokens that other computers need
    Token(token::Arguments),
    /// Copies everything that the server keeps, also while it runs
    Backup(backup::Arguments),
    /// Checks that everything that the server keeps is what was stored
    Verify(verify::Arguments),
}

fn main() -> ExitCode {
    let result = match CommandLine::parse().command {
        Command::Infer(arguments) => infer::run(&arguments),
        Command::Plan(arguments) => plan::run(&arguments),
        Command::Check(arguments) => check::run(&arguments),
        Command::Export(arguments) => export::run(&arguments),
        Command::Executor(arguments) => executor::run(&arguments),
        Command::Schema(arguments) => schema::run(&arguments),
        Command::Serve(arguments) => serve::run(&arguments),
        Command::Token(arguments) => token::run(&arguments),
        Command::Backup(arguments) => backup::run(&arguments),
        Command::Verify(arguments) => verify::run(&arguments),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            for line in failure.lines() {
                output::say(line);
            }
            ExitCode::from(failure.exit_status())
        }
    }
}
