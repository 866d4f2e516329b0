//! What programs rely on: tools and work offsets.

use super::convert::Check;
use super::raw::RawTool;
use std::collections::BTreeMap;
use toml::Spanned;
use traverse_geometry::{COORDINATE_LIMIT_MM, Vector};

/// Work offsets in the order of their numbers.
const OFFSETS: [&str; 9] = ["G54", "G55", "G56", "G57", "G58", "G59", "G59.1", "G59.2", "G59.3"];

impl Check<'_> {
    /// Clearances by tool number.
    pub(super) fn tools(&mut self, stated: BTreeMap<String, Spanned<RawTool>>) -> BTreeMap<u32, f64> {
        let mut tools = BTreeMap::new();
        for (number, tool) in stated {
            let line = self.line_of(&tool);
            let key = format!("tools.{number}");
            let clearance = match tool.into_inner() {
                RawTool { clearance_mm: Some(clearance), diameter_mm: None, margin_mm: None } => clearance,
                RawTool { clearance_mm: None, diameter_mm: Some(diameter), margin_mm: Some(margin) } => {
                    if !(diameter >= 0.0 && margin >= 0.0) {
                        self.add(line, &key, "diameter_mm and margin_mm must not be negative");
                    }
                    diameter / 2.0 + margin
                }
                _ => {
                    self.add(line, &key, "write clearance_mm, or diameter_mm and margin_mm");
                    continue;
                }
            };
            self.clearance_in_range(line, &key, clearance);
            match number.parse() {
                Ok(number) => {
                    tools.insert(number, clearance);
                }
                Err(_) => self.add(line, &key, "a tool's name is its number, such as 3"),
            }
        }
        tools
    }

    /// Zeros of work offsets in the drawing.
    pub(super) fn offsets(&mut self, stated: BTreeMap<String, Spanned<[f64; 2]>>) -> BTreeMap<u8, Vector> {
        let mut offsets = BTreeMap::new();
        for (name, place) in stated {
            let line = self.line_of(&place);
            let key = format!("offsets.{name}");
            let [x, y] = place.into_inner();
            if [x, y].iter().any(|value| value.is_nan() || value.abs() > COORDINATE_LIMIT_MM) {
                self.add(line, &key, format!("[{x}, {y}] is out of range; use ±{COORDINATE_LIMIT_MM} mm"));
            }
            match OFFSETS.iter().zip(0..).find(|(known, _)| known.eq_ignore_ascii_case(&name)) {
                Some((_, number)) => {
                    offsets.insert(number, Vector::new(x, y));
                }
                None => self.add(line, &key, format!("no work offset; use {}", OFFSETS.join(", "))),
            }
        }
        offsets
    }
}
