//! What is said to prove a lower bound of a layout, in the checker's own terms, and what is wrong with it as it stands.

use traverse_geometry::{Finding, Reason, SectionLayout, SlideRule};

/// What is said to prove that no layout is shorter.
#[derive(Clone, Debug, PartialEq)]
pub enum LayoutCertificate {
    /// Duals of joins. Only where sections keep their order.
    Joins(JoinPrices),
    /// The thicknesses of all copies at this height and the gaps between them.
    Height {
        /// The height, millimetres.
        y_mm: f64,
    },
    /// The least width of one section.
    Width {
        /// Which section.
        section: usize,
    },
}

/// Prices of joins. Nodes are the sections, each left and entered as often as it has copies, and last the ends of the
/// strip, left and entered once.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct JoinPrices {
    /// Of nodes left, millimetres: one for each section and one for the ends.
    pub rows_mm: Vec<f64>,
    /// Of nodes entered, likewise.
    pub columns_mm: Vec<f64>,
    /// Sets of nodes that every layout must leave, with the price of that, 0 or more millimetres.
    pub sets: Vec<(Vec<usize>, f64)>,
}

/// Most pairs of sections in poses that duals are held against: as many as 600 sections in four poses make.
pub const CERTIFIED_PAIR_LIMIT: usize = 5_760_000;

/// Most nodes in all sets of a certificate together.
pub const CERTIFICATE_NODE_LIMIT: usize = 4_000_000;

/// Largest absolute value of a dual, millimetres: far beyond any layout, and sums stay finite.
pub const LARGEST_DUAL_MM: f64 = 1e12;

/// So many findings are listed.
const FINDING_LIMIT: usize = 100;

/// Everything that keeps `certificate` from being held against `layout`: numbers that are none, wrong counts, nodes that
/// there are not. Fields are those of the Certificate message. That it claims too much is no finding: it proves less
/// then. Cost: linear.
#[must_use]
pub fn certificate_findings(layout: &SectionLayout, certificate: &LayoutCertificate) -> Vec<Finding> {
    let mut found = Found { findings: Vec::new() };
    match certificate {
        LayoutCertificate::Height { y_mm } => found.finite("height_mm", *y_mm),
        LayoutCertificate::Width { section } => {
            if *section >= layout.sections.len() {
                let count = layout.sections.len();
                let message = format!("there is no section number {section}; the layout has {count}");
                found.add("section_id", Reason::UnknownId, section, message);
            }
        }
        LayoutCertificate::Joins(prices) => found.joins(layout, prices),
    }
    found.findings
}

struct Found {
    findings: Vec<Finding>,
}

impl Found {
    fn add(&mut self, field: impl Into<String>, reason: Reason, value: impl ToString, message: String) {
        if self.findings.len() < FINDING_LIMIT {
            self.findings.push(Finding::new(field, reason, value, message));
        }
    }

    fn finite(&mut self, field: &str, value: f64) {
        if !value.is_finite() {
            let message = format!("{value} is not a finite number; send one");
            self.add(field, Reason::NotFinite, value, message);
        } else if value.abs() > LARGEST_DUAL_MM {
            let message =
                format!("{value:e} is out of range; send at most {LARGEST_DUAL_MM:e} mm either way");
            self.add(field, Reason::OutOfRange, value, message);
        }
    }

    fn joins(&mut self, layout: &SectionLayout, prices: &JoinPrices) {
        if layout.slide_rule != SlideRule::KeepOrder {
            let message = "duals of joins bound layouts that keep their order, and this one slides freely; \
                           send a height or a section instead";
            self.add("row_duals", Reason::NotApplicable, prices.rows_mm.len(), message.to_owned());
            return;
        }
        let items = layout.sections.iter().map(|section| section.poses.len()).sum::<usize>();
        let pairs = items.saturating_mul(items);
        if pairs > CERTIFIED_PAIR_LIMIT {
            let message = format!(
                "{pairs} pairs of sections in their poses, at most {CERTIFIED_PAIR_LIMIT} are held against duals; \
                 leave the certificate out"
            );
            self.add("row_duals", Reason::TooMany, pairs, message);
            return;
        }
        let nodes = layout.sections.len() + 1;
        for (name, duals) in [("row_duals", &prices.rows_mm), ("column_duals", &prices.columns_mm)] {
            if duals.len() != nodes {
                let message = format!(
                    "{} duals given, {nodes} needed; send one for each section and, last, one for the ends",
                    duals.len()
                );
                self.add(name, Reason::OutOfRange, duals.len(), message);
            }
            for (at, &dual) in duals.iter().enumerate() {
                self.finite(&format!("{name}[{at}]"), dual);
            }
        }
        self.sets(&prices.sets, nodes);
    }

    fn sets(&mut self, sets: &[(Vec<usize>, f64)], nodes: usize) {
        let listed: usize = sets.iter().map(|(members, _)| members.len()).sum();
        if listed > CERTIFICATE_NODE_LIMIT {
            let message = format!(
                "{listed} nodes in all sets, at most {CERTIFICATE_NODE_LIMIT} permitted; send fewer sets"
            );
            self.add("sets", Reason::TooMany, listed, message);
            return;
        }
        // The last set, counted from 1, in which each node stood.
        let mut seen_in = vec![0; nodes];
        for (number, (members, weight)) in sets.iter().enumerate() {
            let field = format!("sets[{number}]");
            self.finite(&format!("{field}.weight"), *weight);
            if *weight < 0.0 {
                let message = format!("{weight} is negative; send 0 or more");
                self.add(format!("{field}.weight"), Reason::OutOfRange, weight, message);
            }
            let mut different = 0;
            for (at, &node) in members.iter().enumerate() {
                let wrong = if node >= nodes {
                    format!("there is no node {node}; the layout has {nodes}, counted from 0")
                } else if std::mem::replace(&mut seen_in[node], number + 1) == number + 1 {
                    format!("node {node} stands in the set twice; list each once")
                } else {
                    different += 1;
                    continue;
                };
                self.add(format!("{field}.nodes[{at}]"), Reason::OutOfRange, node, wrong);
            }
            if members.is_empty() || different >= nodes {
                let message = format!(
                    "{} of {nodes} nodes given: no layout must leave such a set; list some, not all",
                    members.len()
                );
                self.add(format!("{field}.nodes"), Reason::OutOfRange, members.len(), message);
            }
        }
    }
}
