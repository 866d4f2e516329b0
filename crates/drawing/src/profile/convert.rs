//! From what a profile says to machines, with every value looked at.

use super::line_index::LineIndex;
use super::raw::{
    RawArcs, RawCornerStyle, RawDialect, RawGcode, RawMachine, RawObstacleRole, RawObstacleTable, RawPlane,
    RawProfiles, RawSpeeds, RawStraight, RawUnit, RawXWord,
};
use super::{Machine, ProfileFinding};
use crate::{
    ArcMotion, GcodeDialect, GcodePlane, GcodeSettings, GcodeUnit, ObstacleRole, Selector, StraightMotion,
    XWord,
};
use toml::Spanned;
use traverse_geometry::{COORDINATE_LIMIT_MM, CornerStyle, LARGEST_CLEARANCE_MM, SMALLEST_CLEARANCE_MM};

/// How far outside an arc chords lie unless the profile says otherwise, millimetres.
const CHORD_TOLERANCE_MM: f64 = 0.01;

pub(crate) fn machines(raw: RawProfiles, text: &str) -> Result<Vec<Machine>, Vec<ProfileFinding>> {
    let lines = LineIndex::new(text);
    let mut findings = Vec::new();
    let mut machines = Vec::new();
    for (name, raw) in raw.machine {
        let line = lines.line(raw.span().start);
        let mut check = Check { table: format!("machine.{name}"), lines: &lines, findings: &mut findings };
        if name.trim().is_empty() {
            check.add(line, "", "the machine has no name; give it one");
        }
        machines.push(check.machine(name, raw.into_inner()));
    }
    findings.sort_by_key(|finding| finding.line);
    if findings.is_empty() { Ok(machines) } else { Err(findings) }
}

pub(super) struct Check<'a> {
    table: String,
    lines: &'a LineIndex,
    findings: &'a mut Vec<ProfileFinding>,
}

impl Check<'_> {
    pub(super) fn add(&mut self, line: usize, key: &str, message: impl Into<String>) {
        let key = if key.is_empty() { self.table.clone() } else { format!("{}.{key}", self.table) };
        self.findings.push(ProfileFinding { line, key, message: message.into() });
    }

    pub(super) fn line_of<T>(&self, value: &Spanned<T>) -> usize {
        self.lines.line(value.span().start)
    }

    fn machine(&mut self, name: String, raw: RawMachine) -> Machine {
        let corner_style = self.corner_style(&raw);
        let (g0, speeds) = (self.g0(&raw), self.speeds(&raw));
        Machine {
            work_area: self.selectors("roles.work_area", raw.roles.work_area),
            parts: self.selectors("roles.parts", raw.roles.parts),
            sections: self.selectors("roles.sections", raw.roles.sections),
            obstacles: self.obstacles("roles.obstacles", raw.roles.obstacles),
            clearance_mm: self.clearance("clearance_mm", raw.clearance_mm),
            border_clearance_mm: self.clearance("border_clearance_mm", raw.border_clearance_mm),
            corner_style,
            tool_clearances_mm: self.tools(raw.tools),
            offsets: self.offsets(raw.offsets),
            g0,
            speeds,
            gcode: raw.gcode.map(|gcode| self.gcode(gcode, &raw.speeds)),
            name,
        }
    }

    fn selectors(&mut self, key: &str, stated: Option<Spanned<Vec<String>>>) -> Option<Vec<Selector>> {
        let stated = stated?;
        let line = self.line_of(&stated);
        let texts = stated.into_inner();
        self.list(line, key, texts.len());
        Some(texts.iter().map(|text| self.selector(line, key, text)).collect())
    }

    fn obstacles(
        &mut self,
        key: &str,
        stated: Option<Spanned<Vec<RawObstacleRole>>>,
    ) -> Option<Vec<ObstacleRole>> {
        let stated = stated?;
        let line = self.line_of(&stated);
        let roles = stated.into_inner();
        self.list(line, key, roles.len());
        let role = |raw: RawObstacleRole| {
            let RawObstacleTable { select, top_mm, clearance_mm } = match raw {
                RawObstacleRole::Table(table) => table,
                RawObstacleRole::Selector(select) => {
                    RawObstacleTable { select, top_mm: None, clearance_mm: None }
                }
            };
            if let Some(top) = top_mm.filter(|top| top.abs() > COORDINATE_LIMIT_MM || top.is_nan()) {
                self.add(line, key, format!("top_mm = {top} is out of range; use ±{COORDINATE_LIMIT_MM} mm"));
            }
            if let Some(clearance) = clearance_mm {
                self.clearance_in_range(line, key, clearance);
            }
            ObstacleRole { selector: self.selector(line, key, &select), top_mm, clearance_mm }
        };
        Some(roles.into_iter().map(role).collect())
    }

    fn list(&mut self, line: usize, key: &str, count: usize) {
        if count == 0 {
            self.add(line, key, "the list is empty; name a selector, or leave the key out for the default");
        }
    }

    fn selector(&mut self, line: usize, key: &str, text: &str) -> Selector {
        let selector = Selector::new(text);
        if selector.is_empty() {
            self.add(line, key, "a selector is empty and fits nothing; name one, such as \"CLAMPS*\"");
        }
        selector
    }

    fn clearance(&mut self, key: &str, stated: Option<Spanned<f64>>) -> Option<f64> {
        let stated = stated?;
        let clearance = *stated.get_ref();
        let line = self.line_of(&stated);
        self.clearance_in_range(line, key, clearance);
        Some(clearance)
    }

    pub(super) fn clearance_in_range(&mut self, line: usize, key: &str, clearance: f64) {
        if clearance != 0.0 && !(SMALLEST_CLEARANCE_MM..=LARGEST_CLEARANCE_MM).contains(&clearance) {
            let (least, largest) = (SMALLEST_CLEARANCE_MM, LARGEST_CLEARANCE_MM);
            self.add(line, key, format!("{clearance} is no clearance; use 0, or {least} to {largest} mm"));
        }
    }

    fn corner_style(&mut self, raw: &RawMachine) -> Option<CornerStyle> {
        let style = raw.corner_style.as_ref().map(|style| *style.get_ref());
        if let Some(limit) = &raw.miter_limit {
            let line = self.line_of(limit);
            if style != Some(RawCornerStyle::Miter) {
                self.add(line, "miter_limit", "has no effect on round corners; set corner_style = \"miter\"");
            }
            if !(limit.get_ref().is_finite() && *limit.get_ref() >= 1.0) {
                self.add(line, "miter_limit", format!("{} is no ratio; use 1 or more", limit.get_ref()));
            }
        }
        let limit = raw.miter_limit.as_ref().map(|limit| *limit.get_ref());
        style.map(|style| match style {
            RawCornerStyle::Round => CornerStyle::Round,
            RawCornerStyle::Miter => CornerStyle::Miter { limit },
        })
    }

    fn gcode(&mut self, table: Spanned<RawGcode>, speeds: &RawSpeeds) -> GcodeSettings {
        let table_line = self.line_of(&table);
        let raw = table.into_inner();
        self.without_effect(&raw);
        let arcs = match raw.arcs.unwrap_or(RawArcs::Fed) {
            RawArcs::Chords => ArcMotion::Chords {
                tolerance_mm: value(&raw.chord_tolerance_mm).unwrap_or(CHORD_TOLERANCE_MM),
            },
            RawArcs::Fed => ArcMotion::Fed {
                feed_mm_per_min: self.feed(table_line, "arc_feed_mm_per_min", &speeds.arc_feed_mm_per_min),
            },
        };
        let straight = match raw.straight.unwrap_or(RawStraight::G0) {
            RawStraight::G0 => StraightMotion::Rapid,
            RawStraight::G1 => StraightMotion::Fed {
                feed_mm_per_min: self.feed(
                    table_line,
                    "straight_feed_mm_per_min",
                    &speeds.straight_feed_mm_per_min,
                ),
            },
        };
        let settings = GcodeSettings {
            dialect: match raw.dialect.unwrap_or(RawDialect::LinuxCnc) {
                RawDialect::LinuxCnc => GcodeDialect::LinuxCnc,
                RawDialect::Grbl => GcodeDialect::Grbl,
                RawDialect::Fanuc => GcodeDialect::Fanuc,
            },
            unit: match raw.unit.unwrap_or(RawUnit::Mm) {
                RawUnit::Mm => GcodeUnit::Millimetres,
                RawUnit::Inch => GcodeUnit::Inches,
            },
            plane: match raw.plane.unwrap_or(RawPlane::G17) {
                RawPlane::G17 => GcodePlane::Xy,
                RawPlane::G18 => GcodePlane::Zx {
                    x: match value(&raw.x_word).unwrap_or(RawXWord::Radius) {
                        RawXWord::Radius => XWord::Radius,
                        RawXWord::Diameter => XWord::Diameter,
                    },
                },
            },
            decimals: value(&raw.decimals),
            straight,
            arcs,
            safe_start: raw.safe_start.as_ref().map(|stated| stated.get_ref().clone()),
            header: raw.header.as_ref().map(|stated| stated.get_ref().clone()).unwrap_or_default(),
            footer: raw.footer.as_ref().map(|stated| stated.get_ref().clone()),
            program_number: value(&raw.program_number).unwrap_or(1),
        };
        self.settings(&settings, table_line, &raw, speeds);
        settings
    }

    /// Keys that the rest of the table makes void.
    fn without_effect(&mut self, raw: &RawGcode) {
        if let Some(stated) = raw.x_word.as_ref().filter(|_| raw.plane != Some(RawPlane::G18)) {
            let line = self.line_of(stated);
            self.add(line, "gcode.x_word", "has no effect in G17; set plane = \"G18\" or leave it out");
        }
        if let Some(stated) = raw.chord_tolerance_mm.as_ref().filter(|_| raw.arcs != Some(RawArcs::Chords)) {
            let line = self.line_of(stated);
            let message = "has no effect on fed arcs; set arcs = \"chords\" or leave it out";
            self.add(line, "gcode.chord_tolerance_mm", message);
        }
        let fanuc = matches!(raw.dialect, Some(RawDialect::Fanuc));
        if let Some(stated) = raw.program_number.as_ref().filter(|_| !fanuc) {
            let line = self.line_of(stated);
            self.add(line, "gcode.program_number", "only Fanuc programs have a number; leave it out");
        }
    }

    /// The feed, or a finding and one that passes.
    fn feed(&mut self, table_line: usize, key: &str, stated: &Option<Spanned<f64>>) -> f64 {
        value(stated).unwrap_or_else(|| {
            let message = format!("is missing but the g-code needs it; write {key} = 1000 under speeds");
            self.add(table_line, &format!("speeds.{key}"), message);
            1000.0
        })
    }

    fn settings(&mut self, settings: &GcodeSettings, table_line: usize, raw: &RawGcode, speeds: &RawSpeeds) {
        for finding in settings.check() {
            let (table, span) = match finding.field {
                "arc_feed_mm_per_min" => ("speeds", span(&speeds.arc_feed_mm_per_min)),
                "straight_feed_mm_per_min" => ("speeds", span(&speeds.straight_feed_mm_per_min)),
                "decimals" => ("gcode", span(&raw.decimals)),
                "x_word" => ("gcode", span(&raw.x_word)),
                "program_number" => ("gcode", span(&raw.program_number)),
                "chord_tolerance_mm" => ("gcode", span(&raw.chord_tolerance_mm)),
                "header" => ("gcode", span(&raw.header)),
                "safe_start" => ("gcode", span(&raw.safe_start)),
                "footer" => ("gcode", span(&raw.footer)),
                _ => ("gcode", None),
            };
            let line = span.map_or(table_line, |start| self.lines.line(start));
            self.add(
                line,
                &format!("{table}.{}", finding.field),
                format!("is {}: {}", finding.value, finding.message),
            );
        }
    }
}

fn value<T: Copy>(stated: &Option<Spanned<T>>) -> Option<T> {
    stated.as_ref().map(|stated| *stated.get_ref())
}

fn span<T>(stated: &Option<Spanned<T>>) -> Option<usize> {
    stated.as_ref().map(|stated| stated.span().start)
}
