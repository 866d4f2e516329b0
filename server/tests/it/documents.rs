//! docs/errors.md and docs/limits.md say what the code does, in both directions.

use std::collections::BTreeMap;
use traverse_checker::ViolationReason;
use traverse_geometry::Reason;
use traverse_proto::REASONS;
use traverse_server::{Caller, Config, Server};

fn page(name: &str) -> String {
    let path = format!("{}/../docs/{name}", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// The sections below a chapter, and how many lines of text each has.
fn sections(page: &str, chapter: &str) -> Vec<(String, usize)> {
    let mut sections: Vec<(String, usize)> = Vec::new();
    let lines = page.lines().skip_while(|line| *line != format!("## {chapter}")).skip(1);
    for line in lines.take_while(|line| !line.starts_with("## ")) {
        if let Some(title) = line.strip_prefix("### ") {
            sections.push((title.trim_matches('`').to_owned(), 0));
        } else if let Some(last) = sections.last_mut().filter(|_| !line.trim().is_empty()) {
            last.1 += 1;
        }
    }
    sections
}

fn assert_chapter(chapter: &str, reasons: impl IntoIterator<Item = &'static str>) {
    let sections = sections(&page("errors.md"), chapter);
    let titles: Vec<&str> = sections.iter().map(|(title, _)| title.as_str()).collect();
    let reasons: Vec<&str> = reasons.into_iter().collect();
    assert_eq!(titles, reasons, "docs/errors.md, chapter {chapter}");
    for (title, lines) in &sections {
        assert!(*lines > 0, "docs/errors.md says nothing about {title}");
    }
}

#[test]
fn every_reason_has_its_section_and_every_section_its_reason() {
    assert_chapter("Refused calls", REASONS.iter().copied());
    assert_chapter("Findings", Reason::ALL.iter().map(|reason| reason.as_str()));
    assert_chapter("Violations", ViolationReason::ALL.iter().map(|reason| reason.as_str()));
}

#[tokio::test]
async fn every_limit_stands_on_its_page_with_its_value() {
    let caller = Caller::InProcess(Box::new(Server::new(Config::on_free_port()).expect("sound")));
    let answer = caller.call("GetLimits", "{}").await.expect("told");
    let told: serde_json::Map<String, serde_json::Value> = serde_json::from_str(&answer).expect("JSON");
    let told: BTreeMap<String, String> = told
        .into_iter()
        .filter(|(name, _)| name != "serverVersion")
        .map(|(name, value)| (name, value.as_str().map_or_else(|| value.to_string(), str::to_owned)))
        .collect();
    let page = page("limits.md");
    let rows = page.lines().filter_map(|line| {
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        let name = cells.get(1)?.strip_prefix('`')?.strip_suffix('`')?;
        Some((name.to_owned(), cells.get(2)?.replace(' ', "")))
    });
    let written: BTreeMap<String, String> = rows.take_while(|(name, _)| told.contains_key(name)).collect();
    assert_eq!(written, told, "docs/limits.md, the first table");
}
