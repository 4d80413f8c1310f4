//! The `sonarfleet` command line.

mod args;
mod commands;
mod log;
mod progress;

use args::{Cli, Command};
use clap::Parser;
use commands::Manner;
use std::process::ExitCode;

fn main() -> ExitCode {
    let cli = Cli::parse();
    log::start();
    match dispatch(&cli) {
        Ok(()) => ExitCode::SUCCESS,
        // Whoever read our output has seen enough.
        Err(error) if is_broken_pipe(&error) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}

fn dispatch(cli: &Cli) -> anyhow::Result<()> {
    if let Some(threads) = cli.threads {
        rayon::ThreadPoolBuilder::new().num_threads(threads.into()).build_global()?;
    }
    let manner = Manner { json: cli.json, quiet: cli.quiet };
    match &cli.command {
        Command::Run(args) => commands::run::run(args, manner),
        Command::Init(args) => commands::init::init(args, manner),
        Command::Check(args) => commands::check::check(args, manner),
        Command::Ocean(command) => commands::ocean::ocean(command, manner),
        Command::Tl(args) => commands::tl::tl(args, manner),
        Command::Bellhop(args) => commands::bellhop::bellhop(args, manner),
        Command::Place(args) => commands::place::place(args, manner),
        Command::Route(args) => commands::route::route(args, manner),
        Command::Assign(args) => commands::assign::assign(args, manner),
        Command::Train(command) => commands::train::train(command, manner),
        Command::Reproduce(args) => commands::reproduce::reproduce(args, manner),
        Command::Bench(command) => commands::bench::bench(command, manner),
    }
}

fn is_broken_pipe(error: &anyhow::Error) -> bool {
    error
        .downcast_ref::<std::io::Error>()
        .is_some_and(|error| error.kind() == std::io::ErrorKind::BrokenPipe)
}
