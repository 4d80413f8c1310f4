//! `sonarfleet init`: a commented scenario to start from.

use super::Manner;
use crate::args::InitArgs;
use anyhow::{Context, Result};
use sonarfleet::scenario::EMBEDDED;
use std::fs::File;
use std::io::Write;

pub(crate) fn init(args: &InitArgs, manner: Manner) -> Result<()> {
    let path = args.path.display();
    let mut file = File::create_new(&args.path).with_context(|| format!("{path}"))?;
    file.write_all(EMBEDDED.as_bytes()).with_context(|| format!("{path}"))?;
    if manner.json {
        super::print_json(&serde_json::json!({ "scenario": args.path }))?;
    } else if !manner.quiet {
        super::say(format_args!("Wrote {path}. Next: sonarfleet check {path}"))?;
    }
    Ok(())
}
