use crate::{SMALL, degenerate, sample};
use serde_json::Value;
use sonarfleet::record::RunRecord;
use sonarfleet_report::write_report;
use std::fs;

/// A report of the embedded scenario's size must fit into a mail.
const LARGEST_BYTES: usize = 3_000_000;

fn page(record: &RunRecord) -> String {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("report.html");
    write_report(record, &path).unwrap();
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 1, "nothing but the report");
    fs::read_to_string(path).unwrap()
}

fn embedded(page: &str) -> Value {
    let (_, tail) = page.split_once(r#"<script type="application/json" id="record">"#).unwrap();
    serde_json::from_str(tail.split_once("</script>").unwrap().0).unwrap()
}

#[test]
fn the_report_of_a_full_run_loads_nothing_and_fits_into_a_mail() {
    let page = page(&sample::record(sample::FULL));
    assert!(page.len() < LARGEST_BYTES, "{} bytes", page.len());
    for load in ["http:", "https:", "src=", "url(", "@import", "<link", "fetch(", "import("] {
        assert!(!page.contains(load), "the report contains {load}");
    }
    assert!(!page.contains("{{"), "a slot of the page was not filled");
}

#[test]
fn the_record_in_the_page_is_the_run() {
    let record = sample::record(SMALL);
    let data = embedded(&page(&record));
    assert_eq!(data["ocean_source"], "synthetic ocean, not an observation");
    assert_eq!(data["seed"], "20251009");
    assert_eq!(data["epochs"].as_array().unwrap().len(), 2);
    let metrics = &data["epochs"][1]["metrics"];
    let utility = record.epochs[1].metrics.detection_utility;
    assert_eq!(metrics["detection_utility"].as_f64(), Some(utility));
    let routes = data["epochs"][1]["routes"].as_array().unwrap();
    assert_eq!(routes.len(), 5);
    let lost = &routes[4];
    assert_eq!(lost["expected_h"], Value::Null, "an infinite time is null");
    assert!(lost["failure"].is_string());
}

#[test]
fn packed_fields_unpack_to_the_records_values() {
    let mut record = sample::record(SMALL);
    record.epochs[0].prior[3] = f64::NAN;
    let prior = &embedded(&page(&record))["epochs"][0]["prior"];
    let (low, high) = (prior["low"].as_f64().unwrap(), prior["high"].as_f64().unwrap());
    let codes = codes(prior["codes"].as_str().unwrap());
    // Half a step of 16 bits over the range.
    let tolerance = (high - low) / 65534.0 * 0.501;
    for (index, (&value, &code)) in record.epochs[0].prior.iter().zip(&codes).enumerate() {
        if index == 3 {
            assert_eq!(code, u16::MAX);
        } else {
            let unpacked = low + (high - low) * f64::from(code) / 65534.0;
            assert!(
                (unpacked - value).abs() <= tolerance,
                "cell {index}: {unpacked} is not {value}"
            );
        }
    }
}

/// Little-endian 16-bit words in base 64.
fn codes(text: &str) -> Vec<u16> {
    const DIGITS: &str = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let bits: Vec<bool> = text
        .trim_end_matches('=')
        .chars()
        .flat_map(|c| {
            let digit = DIGITS.find(c).unwrap();
            (0..6).rev().map(move |bit| digit >> bit & 1 == 1)
        })
        .collect();
    let byte = |chunk: &[bool]| chunk.iter().fold(0_u8, |byte, &bit| byte << 1 | u8::from(bit));
    let bytes: Vec<u8> = bits.chunks_exact(8).map(byte).collect();
    bytes.chunks_exact(2).map(|pair| u16::from_le_bytes([pair[0], pair[1]])).collect()
}

#[test]
fn texts_cannot_leave_their_place() {
    let mut record = sample::record(SMALL);
    record.name = "</script><script>alert(1)</script> & {{record}}".into();
    record.epochs[0].routes[0].failure = Some("<img onerror=alert(1)>".into());
    let page = page(&record);
    assert!(!page.contains("<script>alert") && !page.contains("<img"));
    assert!(page.contains("&lt;/script&gt;&lt;script&gt;alert(1)"));
    assert_eq!(page.matches("<script").count(), 3);
    assert_eq!(embedded(&page)["name"], record.name);
    assert_eq!(embedded(&page)["epochs"][0]["routes"][0]["failure"], "<img onerror=alert(1)>");
}

#[test]
fn degenerate_records_have_a_report() {
    for (what, record) in degenerate() {
        let data = embedded(&page(&record));
        assert_eq!(data["epochs"].as_array().unwrap().len(), record.epochs.len(), "{what}");
    }
}

#[test]
fn a_place_that_cannot_be_written_is_named() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("missing").join("report.html");
    let error = write_report(&sample::record(SMALL), &path).unwrap_err();
    assert!(error.to_string().contains("report.html"), "{error}");
}
