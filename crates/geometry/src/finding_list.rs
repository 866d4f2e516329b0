//! Findings while they are collected: the first [`FINDINGS_LIMIT`] in full, the rest as a count.

use crate::{FINDINGS_LIMIT, Finding, Reason};

/// Findings of one ring, chain or polygon. A message full of NaN costs no more than its first hundred.
#[derive(Default)]
pub(crate) struct FindingList {
    listed: Vec<Finding>,
    /// Reason of the first finding that is not listed, and how many are not.
    unlisted: Option<(Reason, usize)>,
}

impl FindingList {
    pub(crate) fn push(&mut self, make: impl FnOnce() -> Finding) {
        if self.listed.len() < FINDINGS_LIMIT {
            self.listed.push(make());
        } else {
            let reason = make().reason;
            self.unlisted = Some(self.unlisted.map_or((reason, 1), |(first, count)| (first, count + 1)));
        }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.listed.is_empty()
    }

    /// Adds findings that are bounded in number already.
    pub(crate) fn extend(&mut self, findings: Vec<Finding>) {
        self.listed.extend(findings);
    }

    /// The findings; the last one, at `field`, says how many more there are.
    pub(crate) fn into_findings(self, field: &str) -> Vec<Finding> {
        let mut findings = self.listed;
        if let Some((reason, count)) = self.unlisted {
            findings.push(Finding::new(
                field,
                reason,
                count,
                format!(
                    "{count} more findings are not listed; mend the first {FINDINGS_LIMIT} and send it again"
                ),
            ));
        }
        findings
    }
}
