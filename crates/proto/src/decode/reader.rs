//! Collects what is wrong with a request while it is read.

use crate::{Limits, Refused, text::shortened};
use traverse_geometry::{Finding, Reason};
use traverse_solve::{Budget, Interrupt};

/// Most findings that are kept; the rest is counted. A million wrong numbers must not become a million texts.
const KEPT_FINDINGS: usize = 1000;

/// Reads one request.
pub(crate) struct Reader<'a> {
    pub(crate) limits: &'a Limits,
    budget: &'a Budget,
    findings: Vec<Finding>,
    unlisted: usize,
    interrupt: Option<Interrupt>,
}

impl<'a> Reader<'a> {
    pub(crate) fn new(limits: &'a Limits, budget: &'a Budget) -> Self {
        Self { limits, budget, findings: Vec::new(), unlisted: 0, interrupt: None }
    }

    /// Whether to go on: the caller may be gone, the time over. Asked before each costly part.
    pub(crate) fn goes_on(&mut self) -> bool {
        if self.interrupt.is_none() {
            self.interrupt = self.budget.check(0).err();
        }
        self.interrupt.is_none()
    }

    /// Whether anybody still waits for the answer.
    pub(crate) fn wanted(&self) -> bool {
        self.budget.check(0).is_ok()
    }

    pub(crate) fn report(&mut self, finding: Finding) {
        if self.findings.len() < KEPT_FINDINGS {
            self.findings.push(finding);
        } else {
            self.unlisted += 1;
        }
    }

    pub(crate) fn report_under(&mut self, parent: &str, findings: Vec<Finding>) {
        for finding in findings {
            self.report(finding.under(parent));
        }
    }

    pub(crate) fn missing(&mut self, field: &str, what: &str) {
        self.report(Finding::new(field, Reason::MissingField, "", format!("it is missing; send {what}")));
    }

    pub(crate) fn out_of_range(&mut self, field: &str, value: impl ToString, range: &str) {
        let value = shortened(&value.to_string(), 100);
        let message = format!("{value} is out of range; send {range}");
        self.report(Finding::new(field, Reason::OutOfRange, value, message));
    }

    pub(crate) fn unknown_enum_value(&mut self, field: &str, value: i32, known: &[&str]) {
        let message = format!("{value} is not known here; send one of {}", known.join(", "));
        self.report(Finding::new(field, Reason::UnknownEnumValue, value, message));
    }

    pub(crate) fn at_most(&mut self, field: &str, what: &str, count: usize, limit: usize) {
        if count > limit {
            let message =
                format!("{count} {what} given, at most {limit} permitted; send fewer or split the request");
            self.report(Finding::new(field, Reason::TooMany, count, message));
        }
    }

    /// Refuses when anything is wrong so far.
    pub(crate) fn so_far(&mut self) -> Result<(), Refused> {
        if let Some(interrupt) = self.interrupt {
            return Err(Refused::interrupted(interrupt, None));
        }
        if self.findings.is_empty() {
            return Ok(());
        }
        let mut findings = std::mem::take(&mut self.findings);
        if self.unlisted > 0 {
            let message =
                format!("{} more findings are not listed; mend these and send it again", self.unlisted);
            findings.push(Finding::new("", Reason::TooMany, self.unlisted, message));
        }
        Err(Refused::findings_of(findings))
    }

    /// The value, if it was read and nothing is wrong.
    pub(crate) fn finish<T>(mut self, value: Option<T>) -> Result<T, Refused> {
        self.so_far()?;
        debug_assert!(value.is_some(), "a value that could not be read left no finding");
        value.ok_or_else(|| Refused::findings_of(Vec::new()))
    }
}
