//! What is in a drawing: layers, loops, nesting, unit, findings.

use crate::obstacles::shapes_of;
use crate::overlaps::overlaps;
use crate::role_loops::{RoleLoops, loops_by_role};
use crate::{Drawing, DrawingFinding, LengthUnit, Role, Roles, Unused};
use std::fmt;
use traverse_geometry::Bounds;

/// What is in a drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Inspection {
    /// Unit of the file.
    pub unit: LengthUnit,
    /// Whether that unit was assumed because the file names none.
    pub unit_assumed: bool,
    /// Everything that was read, millimetres. Empty when nothing was.
    pub bounds: Bounds,
    /// Layer by layer; once for each role that its curves have.
    pub layers: Vec<LayerInspection>,
    /// What is wrong, with places.
    pub findings: Vec<DrawingFinding>,
    /// What could not be used.
    pub unused: Vec<Unused>,
    /// How far at most arcs and segments run from the ellipses and splines that they stand for, millimetres.
    pub widest_deviation_mm: f64,
}

/// What is on a layer.
#[derive(Clone, Debug, PartialEq)]
pub struct LayerInspection {
    /// Layer name.
    pub layer: String,
    /// What its curves stand for.
    pub role: Role,
    /// Curves on it.
    pub curve_count: usize,
    /// Their length together, millimetres.
    pub length_mm: f64,
    /// Loops that lie in no other one.
    pub outer_loop_count: usize,
    /// Loops that lie directly inside another one, and all further in.
    pub inner_loop_count: usize,
    /// How many loops lie around one another at most: 0 without loops, 1 when none lies in another.
    pub deepest_nesting: usize,
    /// Area of what is inside the outer loops less holes, plus islands, square millimetres. What is no valid loop does not count.
    pub area_mm2: f64,
}

/// Looks at everything in a drawing, chosen by `roles` or not. Ends no farther apart than `join_tolerance_mm` are
/// joined. Cost: as [`crate::scene_from_drawing`].
#[must_use]
pub fn inspect_drawing(drawing: &Drawing, roles: &Roles, join_tolerance_mm: f64) -> Inspection {
    let curves = || drawing.layers.iter().flat_map(|layer| &layer.curves);
    let bounds = curves().flat_map(crate::Curve::edges).map(|edge| edge.bounds());
    let mut inspection = Inspection {
        unit: drawing.unit,
        unit_assumed: drawing.unit_assumed,
        bounds: bounds.fold(Bounds::EMPTY, Bounds::union),
        layers: Vec::new(),
        findings: Vec::new(),
        unused: drawing.unused.clone(),
        widest_deviation_mm: curves().map(|curve| curve.deviation_mm).fold(0.0, f64::max),
    };
    for mut group in loops_by_role(drawing, roles, join_tolerance_mm, |_| true) {
        inspection.findings.append(&mut group.findings);
        let shared = overlaps(group.layer, &group.curves, &group.repeated_curves, join_tolerance_mm);
        inspection.findings.extend(shared);
        let shapes = shapes_of(&group, &mut inspection.findings);
        let area_mm2 = shapes.iter().map(|shape| shape.polygon.area()).fold(0.0, |sum, area| sum + area);
        inspection.layers.push(LayerInspection { area_mm2, ..group.inspection() });
    }
    inspection
}

impl RoleLoops<'_> {
    fn inspection(&self) -> LayerInspection {
        let outer_loop_count = self.forest.roots().count();
        LayerInspection {
            layer: self.layer.to_owned(),
            role: self.chosen.role,
            curve_count: self.curves.len(),
            length_mm: self.curves.iter().map(crate::Curve::length).sum(),
            outer_loop_count,
            inner_loop_count: self.loops.len() - outer_loop_count,
            deepest_nesting: self.forest.depths.iter().map(|depth| depth + 1).max().unwrap_or(0),
            area_mm2: 0.0,
        }
    }
}

/// So many findings are listed when an inspection is printed.
const LISTED_FINDINGS: usize = 40;

impl fmt::Display for Inspection {
    /// A table of layers, then findings (the first 40) and what could not be used, a line each.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let assumed = if self.unit_assumed { " (assumed: the file names none)" } else { "" };
        writeln!(f, "unit    {}{assumed}", self.unit)?;
        if !self.bounds.is_empty() {
            let (min, size) = (self.bounds.min, self.bounds.size());
            writeln!(f, "size    {:.3} x {:.3} mm, from {:.3},{:.3}", size.x, size.y, min.x, min.y)?;
        }
        let width = self.layers.iter().map(|layer| layer.layer.chars().count()).max().unwrap_or(0).max(5);
        writeln!(
            f,
            "\n{:<width$}  {:<10} {:>7} {:>7} {:>7} {:>7} {:>14} {:>16}",
            "layer", "role", "curves", "outer", "inner", "nesting", "length mm", "area mm2"
        )?;
        for each in &self.layers {
            writeln!(
                f,
                "{:<width$}  {:<10} {:>7} {:>7} {:>7} {:>7} {:>14.3} {:>16.3}",
                each.layer,
                each.role.to_string(),
                each.curve_count,
                each.outer_loop_count,
                each.inner_loop_count,
                each.deepest_nesting,
                each.length_mm,
                each.area_mm2
            )?;
        }
        if self.widest_deviation_mm > 0.0 {
            writeln!(
                f,
                "\nellipses and splines are taken as arcs and segments within {} mm",
                self.widest_deviation_mm
            )?;
        }
        if self.findings.is_empty() && self.unused.is_empty() {
            return writeln!(f, "\nnothing is wrong with it");
        }
        writeln!(f)?;
        for (finding, number) in self.findings.iter().zip(1..).take(LISTED_FINDINGS) {
            writeln!(f, "{number:>3}. {finding}")?;
        }
        if self.findings.len() > LISTED_FINDINGS {
            writeln!(f, "and {} findings more", self.findings.len() - LISTED_FINDINGS)?;
        }
        for unused in &self.unused {
            writeln!(f, "not used: {unused}")?;
        }
        Ok(())
    }
}
