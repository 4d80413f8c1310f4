//! The report: one HTML file that needs nothing beside it.

mod pack;
mod view;

use crate::error::written;
use crate::error::{ReportError, Result};
use crate::figures::region_deg;
use crate::{colour, valid};
use serde::Serialize;
use sonarfleet::record::RunRecord;
use std::path::Path;

const PAGE: &str = include_str!("../../assets/report.html");
const STYLE: &str = include_str!("../../assets/report.css");
/// In order of use: each knows only those before it.
const SCRIPTS: [&str; 7] = [
    include_str!("../../assets/js/data.js"),
    include_str!("../../assets/js/draw.js"),
    include_str!("../../assets/js/layers.js"),
    include_str!("../../assets/js/map.js"),
    include_str!("../../assets/js/section.js"),
    include_str!("../../assets/js/numbers.js"),
    include_str!("../../assets/js/main.js"),
];

/// Writes the interactive report of a run: one file with maps, routes, sections
/// of sound speed and key numbers of every epoch, which opens in any browser
/// without a network. The file is whole or not there.
///
/// # Errors
///
/// A record whose arrays do not fit its grids, and a file that cannot be written.
pub fn write_report(record: &RunRecord, path: impl AsRef<Path>) -> Result<()> {
    let path = path.as_ref();
    valid::check(record)?;
    let tables = Tables {
        amp: colour::AMP.to_hex(),
        balance: colour::BALANCE.to_hex(),
        deep: colour::DEEP.to_hex(),
        dense: colour::DENSE.to_hex(),
        loss: colour::LOSS.to_hex(),
        speed: colour::SPEED.to_hex(),
        thermal: colour::THERMAL.to_hex(),
    };
    let encode = |source| ReportError::Encode { path: path.to_owned(), source };
    let data =
        serde_json::to_string(&view::Report::new(record, region_deg(record))).map_err(encode)?;
    let tables = serde_json::to_string(&tables).map_err(encode)?;
    let scripts = SCRIPTS.concat();
    let page = fill(PAGE, |slot| match slot {
        "title" => escape(&record.name),
        "style" => STYLE.to_owned(),
        "tables" => tables.clone(),
        "record" => script_safe(&data),
        "script" => scripts.clone(),
        other => unreachable!("the page has no slot `{other}`"),
    });
    written(path, page.as_bytes())
}

/// cmocean's colours, low to high, six hexadecimal digits each.
#[derive(Serialize)]
struct Tables {
    amp: String,
    balance: String,
    deep: String,
    dense: String,
    loss: String,
    speed: String,
    thermal: String,
}

/// Fills the slots `{{name}}` of a page, once each and not within what is filled in.
fn fill(page: &str, value: impl Fn(&str) -> String) -> String {
    let mut filled = String::new();
    let mut rest = page;
    while let Some((before, (slot, after))) =
        rest.split_once("{{").and_then(|(before, tail)| Some((before, tail.split_once("}}")?)))
    {
        filled.push_str(before);
        filled.push_str(&value(slot));
        rest = after;
    }
    filled.push_str(rest);
    filled
}

fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&#39;"),
            c => escaped.push(c),
        }
    }
    escaped
}

/// JSON that cannot end the script element it stands in.
fn script_safe(json: &str) -> String {
    json.replace('<', "\\u003c").replace('>', "\\u003e").replace('&', "\\u0026")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slots_are_not_filled_within_what_is_filled_in() {
        assert_eq!(
            fill("a {{x}} b {{y}}", |slot| format!("<{slot}{{{{y}}}}>")),
            "a <x{{y}}> b <y{{y}}>"
        );
    }
}
