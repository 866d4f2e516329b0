//! Certificates of bounds that are sent back to be checked.

use super::reader::Reader;
use super::section::Ids;
use crate::v1;
use traverse_checker::{
    BoundClaim, CERTIFICATE_NODE_LIMIT, JoinPrices, LayoutCertificate, certificate_findings,
};
use traverse_geometry::{Finding, Reason, SectionLayout};

/// The field of the certificate.
const FIELD: &str = "certificate";
const CLAIM: &str = "claimed_lower_bound_mm";

impl Reader<'_> {
    /// What is claimed beside a layout; the inner none: nothing.
    #[expect(clippy::option_option, reason = "the outer one: it was read")]
    pub(crate) fn bound_claim(
        &mut self,
        certificate: Option<v1::Certificate>,
        claimed: Option<f64>,
        layout: Option<&SectionLayout>,
        ids: &Ids,
    ) -> Option<Option<BoundClaim>> {
        let lower_bound_mm = match claimed {
            None => Some(None),
            Some(mm) => self.within(CLAIM, mm, |mm| mm >= 0.0, "0 or more").map(Some),
        };
        let Some(certificate) = certificate else {
            if let Some(mm) = claimed {
                let message = "there is no certificate that could prove it; send one, or leave the bound out";
                self.report(Finding::new(CLAIM, Reason::NotApplicable, mm, message));
                return None;
            }
            return Some(None);
        };
        let certificate = self.certificate(certificate, ids)?;
        let findings = certificate_findings(layout?, &certificate);
        let is_sound = findings.is_empty();
        self.report_under(FIELD, findings);
        let claim = BoundClaim { certificate, lower_bound_mm: lower_bound_mm? };
        is_sound.then_some(Some(claim))
    }

    /// A certificate of exactly one kind.
    fn certificate(&mut self, wire: v1::Certificate, ids: &Ids) -> Option<LayoutCertificate> {
        let v1::Certificate { row_duals, column_duals, sets, height_mm, section_id } = wire;
        let has_duals = !(row_duals.is_empty() && column_duals.is_empty() && sets.is_empty());
        match (has_duals, height_mm, section_id.is_empty()) {
            (true, None, true) => {
                let sets = self.dual_sets(sets)?;
                let prices = JoinPrices { rows_mm: row_duals, columns_mm: column_duals, sets };
                Some(LayoutCertificate::Joins(prices))
            }
            (false, Some(y_mm), true) => Some(LayoutCertificate::Height { y_mm }),
            (false, None, false) => {
                let section = self.section_named(&format!("{FIELD}.section_id"), &section_id, ids)?;
                Some(LayoutCertificate::Width { section })
            }
            (false, None, true) => {
                self.missing(FIELD, "duals of joins, height_mm, or section_id, or leave the certificate out");
                None
            }
            _ => {
                let message =
                    "duals of joins, height_mm and section_id are three kinds; send one of them only";
                self.report(Finding::new(FIELD, Reason::NotApplicable, "", message));
                None
            }
        }
    }

    fn dual_sets(&mut self, sets: Vec<v1::DualSet>) -> Option<Vec<(Vec<usize>, f64)>> {
        let nodes = sets.iter().map(|set| set.nodes.len()).sum();
        let field = format!("{FIELD}.sets");
        if nodes > CERTIFICATE_NODE_LIMIT {
            self.at_most(&field, "nodes in all sets", nodes, CERTIFICATE_NODE_LIMIT);
            return None;
        }
        let mut read = Vec::with_capacity(sets.len());
        for (number, set) in sets.into_iter().enumerate() {
            let members: Result<Vec<usize>, usize> = (set.nodes.iter().enumerate())
                .map(|(at, &node)| usize::try_from(node).map_err(|_| at))
                .collect();
            match members {
                Ok(members) => read.push((members, set.weight)),
                Err(at) => {
                    let node = set.nodes[at];
                    self.out_of_range(&format!("{field}[{number}].nodes[{at}]"), node, "0 or more");
                    return None;
                }
            }
        }
        Some(read)
    }
}
