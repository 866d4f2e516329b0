//! What rewriting a program has saved, as a table; what stays as it is, and why.

use crate::clock::Clock;
use std::collections::BTreeMap;
use std::fmt;
use traverse_programs::{Done, Link, Outcome, Program, Rewritten};

/// So many changed moves are listed; the rest is counted.
const LISTED_CHANGES: usize = 40;

/// So many lines are named for each reason.
const LISTED_LINES: usize = 8;

/// So many reasons and lines that were not understood are listed.
const LISTED_REASONS: usize = 40;

/// What rewriting a program has saved.
pub(crate) struct ProgramTable<'a> {
    pub(crate) program: &'a Program<'a>,
    pub(crate) rewritten: &'a Rewritten,
    /// How long ways take as they were and as they are written; none: no times are told.
    pub(crate) clocks: Option<[Clock; 2]>,
}

impl ProgramTable<'_> {
    /// Seconds of a link as it was and as it is, where they are known.
    fn seconds(&self, outcome: &Outcome) -> Option<[f64; 2]> {
        let [old, new] = self.clocks.as_ref()?;
        let before = old.seconds(&outcome.before)?;
        let after = match &outcome.done {
            Done::Changed(path) => new.seconds(path)?,
            _ => before,
        };
        Some([before, after])
    }

    fn times(seconds: Option<[f64; 2]>) -> String {
        seconds.map_or_else(String::new, |[before, after]| format!(" {before:>9.2} {after:>9.2}"))
    }

    fn changes(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let outcomes = || self.program.links.iter().zip(&self.rewritten.outcomes);
        let changed = outcomes().filter(|(_, outcome)| matches!(outcome.done, Done::Changed(_)));
        let count = changed.clone().count();
        let times = if self.clocks.is_some() { "  before s   after s" } else { "" };
        writeln!(f, "lines           before mm   after mm   saved mm{times}")?;
        for (link, outcome) in changed.take(LISTED_CHANGES) {
            let (first, last) = lines(link, outcome);
            let lines = if first == last { first.to_string() } else { format!("{first}-{last}") };
            let Outcome { before_mm, after_mm, hits, .. } = outcome;
            let times = Self::times(self.seconds(outcome));
            let hit =
                if hits.is_empty() { String::new() } else { format!("  too near to {}", hits.join(", ")) };
            let saved = before_mm - after_mm;
            writeln!(f, "{lines:<13} {before_mm:>11.3} {after_mm:>10.3} {saved:>10.3}{times}{hit}")?;
        }
        if count > LISTED_CHANGES {
            writeln!(f, "and {} more", count - LISTED_CHANGES)?;
        }
        let sum = |value: fn(&Outcome) -> f64| outcomes().map(|(_, outcome)| value(outcome)).sum::<f64>();
        let (before, after) = (sum(|outcome| outcome.before_mm), sum(|outcome| outcome.after_mm));
        let seconds: Option<Vec<[f64; 2]>> = outcomes().map(|(_, outcome)| self.seconds(outcome)).collect();
        let times = Self::times(seconds.map(|each| {
            each.into_iter().fold([0.0, 0.0], |sum, [before, after]| [sum[0] + before, sum[1] + after])
        }));
        writeln!(f, "{:<13} {before:>11.3} {after:>10.3} {:>10.3}{times}", "all", before - after)?;
        let made_safe = outcomes().filter(|(_, outcome)| outcome.is_made_safe()).count();
        let known = outcomes().count();
        write!(f, "{count} of {known} rapid moves replaced")?;
        match made_safe {
            0 => writeln!(f),
            1 => writeln!(f, "; 1 ran too near to something and no longer does, which may make it longer"),
            _ => writeln!(
                f,
                "; {made_safe} ran too near to something and no longer do, which may make them longer"
            ),
        }
    }

    /// What stays as it is, by reason, in the order of the first line of each.
    fn left(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut reasons: BTreeMap<String, Vec<u32>> = BTreeMap::new();
        for (link, outcome) in self.program.links.iter().zip(&self.rewritten.outcomes) {
            if let Done::Left(reason) = &outcome.done {
                let still = if outcome.still_hits() {
                    format!("STILL TOO NEAR to {}: {reason}", outcome.hits.join(", "))
                } else {
                    format!("left as it is: {reason}")
                };
                reasons.entry(still).or_default().push(link.lines().1);
            }
        }
        for (line, reason) in &self.program.untouched {
            reasons.entry(format!("not looked at: {reason}")).or_default().push(*line);
        }
        for (line, fault) in &self.program.faults {
            reasons.entry(format!("not understood: {fault}")).or_default().push(*line);
        }
        let mut reasons: Vec<(String, Vec<u32>)> = reasons.into_iter().collect();
        reasons.sort_by_key(|(_, lines)| lines.first().copied());
        for (reason, lines) in reasons.iter().take(LISTED_REASONS) {
            let named: Vec<String> = lines.iter().take(LISTED_LINES).map(ToString::to_string).collect();
            let more = lines.len().saturating_sub(LISTED_LINES);
            let more = if more > 0 { format!(" and {more} more") } else { String::new() };
            let word = if lines.len() == 1 { "line" } else { "lines" };
            writeln!(f, "{word} {}{more}: {reason}", named.join(", "))?;
        }
        if reasons.len() > LISTED_REASONS {
            writeln!(f, "and {} reasons more", reasons.len() - LISTED_REASONS)?;
        }
        Ok(())
    }
}

/// The lines of a change: with retract and plunge where those were planned with it.
fn lines(link: &Link, outcome: &Outcome) -> (u32, u32) {
    match &outcome.done {
        Done::Changed(path) if path.start_z_mm.is_some() => link.lines_with_heights(),
        _ => link.lines(),
    }
}

impl fmt::Display for ProgramTable<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.changes(f)?;
        self.left(f)
    }
}
