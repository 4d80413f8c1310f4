//! Placement methods by name, with the policies that some of them need.

use anyhow::Result;
use sonarfleet::placement::auto::Auto;
use sonarfleet::placement::{Method, Solver};
use sonarfleet_learning::placement::paper::{PaperPpo, PaperSettings, Process};
use sonarfleet_learning::placement::transferable::{Network, TransferablePolicy};
use std::path::Path;

/// The solver of a method; `weights` replace those of the policy that ships.
pub(super) fn solver(method: Method, weights: Option<&Path>) -> Result<Box<dyn Solver>> {
    let paper = |process, settings| -> Result<Box<dyn Solver>> {
        Ok(Box::new(PaperPpo::new(process, settings)?))
    };
    match method {
        Method::Auto => Ok(Box::new(Auto { proposers: vec![Box::new(policy(weights)?)] })),
        Method::SequentialPpo => paper(Process::Sequential, PaperSettings::ours()),
        Method::SequentialPpoPaper => paper(Process::Sequential, PaperSettings::paper()),
        Method::ExchangePpo => paper(Process::Exchange, PaperSettings::ours()),
        Method::ExchangePpoPaper => paper(Process::Exchange, PaperSettings::paper()),
        Method::Policy => Ok(Box::new(policy(weights)?)),
        classical => Ok(classical.solver().expect("all methods that learn are above")),
    }
}

/// The policy of these weights, or the one that ships.
pub(super) fn policy(weights: Option<&Path>) -> Result<TransferablePolicy> {
    Ok(match weights {
        Some(path) => TransferablePolicy::new(Network::load(path)?),
        None => TransferablePolicy::shipped(),
    })
}
