//! Sections of a drawing: what is drawn together as a group, a block or a layer is a section.
//!
//! The curves of each section are taken as a drawing of their own: joined to loops, outermost loops are parts, loops directly
//! inside are holes. Cost: n log n.

use crate::{
    Curve, Drawing, JOIN_TOLERANCE_MM, Layer, ObstacleRole, Roles, SceneError, SceneOptions, SceneReport,
    Selector, scene_from_drawing,
};
use std::collections::BTreeMap;
use traverse_geometry::{Motion, Part, Point, Polygon, Pose, Section};

/// What of a drawing is a section.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SectionsBy {
    /// Groups where there are any, otherwise layers where there are several, otherwise every part.
    #[default]
    Found,
    /// Each drawn group that stands in no other, layers aside: a group of an SVG file, an inserted block of a DXF file.
    /// Groups of one name and shape are copies of one section.
    Group,
    /// Each layer.
    Layer,
    /// Each outermost loop with what is inside it.
    Part,
}

/// How a drawing becomes sections.
#[derive(Clone, Debug, PartialEq)]
pub struct SectionOptions {
    /// What is a section.
    pub by: SectionsBy,
    /// What is left out: the sheet's border, notes. Default: the layers that bound the work area of a scene.
    pub ignored: Vec<Selector>,
    /// Ends of lines and arcs that are no farther apart are joined, millimetres. Default: [`JOIN_TOLERANCE_MM`].
    pub join_tolerance_mm: f64,
    /// How each section may be turned. Default: as is.
    pub poses: Vec<Pose>,
}

impl Default for SectionOptions {
    fn default() -> Self {
        Self {
            by: SectionsBy::Found,
            ignored: Roles::default().work_area,
            join_tolerance_mm: JOIN_TOLERANCE_MM,
            poses: vec![Pose::AsIs],
        }
    }
}

/// Sections and what became of the drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct SectionsFromDrawing {
    /// From left to right as they are drawn. A part's pole is the lower left corner of its box.
    pub sections: Vec<Section>,
    /// What was a section.
    pub by: SectionsBy,
    /// What was used, and what is wrong.
    pub report: SceneReport,
    /// Curves that belong to no section.
    pub outside_count: usize,
    /// Closed loops that were found in none of the sections although curves were there: ids of empty sections.
    pub empty: Vec<String>,
}

impl SectionsFromDrawing {
    /// Whether everything that was drawn is in a section.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        self.report.is_complete() && self.outside_count == 0 && self.empty.is_empty()
    }
}

/// Why a drawing has no sections.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SectionsError {
    /// Nothing in it is a section.
    #[error(
        "the drawing holds no section: no closed outline in any {what}; group what belongs together, or choose \
             another way with --sections"
    )]
    None {
        /// What was looked for.
        what: &'static str,
    },
    /// The curves can't be taken.
    #[error(transparent)]
    Scene(#[from] SceneError),
}

/// Makes a drawing the sections of a layout.
///
/// # Errors
/// When nothing is a section. Everything else is in the report.
pub fn sections_from_drawing(
    drawing: &Drawing,
    options: &SectionOptions,
) -> Result<SectionsFromDrawing, SectionsError> {
    let by = found_by(drawing, options);
    let (groups, outside_count) = groups_of(drawing, options, by);
    let mut report = whole_report(drawing, options)?;
    let mut sections: Vec<Section> = Vec::new();
    let mut empty = Vec::new();
    for (key, layers) in groups {
        let (parts, of_group) = parts_of(drawing, layers, options)?;
        report.findings.extend(of_group.findings);
        report.widest_deviation_mm = report.widest_deviation_mm.max(of_group.widest_deviation_mm);
        if by == SectionsBy::Part {
            let alone = |part: Part| Section {
                id: part.id.clone(),
                parts: vec![part],
                quantity: 1,
                poses: options.poses.clone(),
            };
            sections.extend(parts.into_iter().map(alone));
        } else if parts.is_empty() {
            empty.push(key.name);
        } else {
            sections.push(Section { id: key.name, parts, quantity: 1, poses: options.poses.clone() });
        }
    }
    if sections.is_empty() {
        return Err(SectionsError::None { what: by.name() });
    }
    sections.sort_by(|a, b| a.bounds().min.x.total_cmp(&b.bounds().min.x));
    let sections = counted(sections);
    Ok(SectionsFromDrawing { sections, by, report, outside_count, empty })
}

impl SectionsBy {
    /// What a section is, for people.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Found => "group or layer",
            Self::Group => "group",
            Self::Layer => "layer",
            Self::Part => "part",
        }
    }
}

/// What the curves of one section have in common.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Key {
    number: u32,
    name: String,
}

fn is_ignored(options: &SectionOptions, layer: &str, curve: &Curve) -> bool {
    options.ignored.iter().any(|selector| selector.chooses(layer, &curve.source))
}

fn found_by(drawing: &Drawing, options: &SectionOptions) -> SectionsBy {
    if options.by != SectionsBy::Found {
        return options.by;
    }
    let used = |layer: &&Layer| layer.curves.iter().any(|curve| !is_ignored(options, &layer.name, curve));
    let has_group = |layer: &Layer| {
        layer
            .curves
            .iter()
            .any(|curve| !is_ignored(options, &layer.name, curve) && curve.source.drawn_group.is_some())
    };
    match drawing.layers.iter().filter(used).count() {
        _ if drawing.layers.iter().any(has_group) => SectionsBy::Group,
        0 | 1 => SectionsBy::Part,
        _ => SectionsBy::Layer,
    }
}

/// The curves of each section by layer; and how many belong to none.
fn groups_of(
    drawing: &Drawing,
    options: &SectionOptions,
    by: SectionsBy,
) -> (BTreeMap<Key, Vec<Layer>>, usize) {
    let mut groups: BTreeMap<Key, Vec<Layer>> = BTreeMap::new();
    let mut outside = 0;
    for (number, layer) in drawing.layers.iter().enumerate() {
        for curve in layer.curves.iter().filter(|curve| !is_ignored(options, &layer.name, curve)) {
            let key = match by {
                SectionsBy::Layer => Some(Key { number: number as u32, name: layer.name.clone() }),
                SectionsBy::Part => Some(Key { number: 0, name: String::new() }),
                SectionsBy::Group | SectionsBy::Found => curve.source.drawn_group.map(|group| Key {
                    number: group.number,
                    name: curve.source.groups.get(group.place).cloned().unwrap_or_default(),
                }),
            };
            let Some(key) = key else {
                outside += 1;
                continue;
            };
            let layers = groups.entry(key).or_default();
            match layers.last_mut().filter(|last| last.name == layer.name) {
                Some(last) => last.curves.push(curve.clone()),
                None => layers.push(Layer { name: layer.name.clone(), curves: vec![curve.clone()] }),
            }
        }
    }
    (groups, outside)
}

/// Every outermost loop of these layers.
fn parts_of(
    drawing: &Drawing,
    layers: Vec<Layer>,
    options: &SectionOptions,
) -> Result<(Vec<Part>, SceneReport), SectionsError> {
    let alone = Drawing { layers, unused: Vec::new(), ..drawing.clone_without_curves() };
    let roles = Roles {
        work_area: Vec::new(),
        parts: vec![Selector::new("*")],
        sections: Vec::new(),
        obstacles: Vec::new(),
    };
    let made = scene_from_drawing(&alone, &SceneOptions { roles, ..scene_options(options) })?;
    Ok((made.parts.into_iter().map(|part| at_pole(part.id, &part.shape)).collect(), made.report))
}

/// What the drawing as a whole says: unit, layers, what could not be read.
fn whole_report(drawing: &Drawing, options: &SectionOptions) -> Result<SceneReport, SectionsError> {
    let roles = Roles {
        work_area: Vec::new(),
        parts: Vec::new(),
        sections: Vec::new(),
        obstacles: vec![ObstacleRole::new("*")],
    };
    let empty = Drawing { unused: drawing.unused.clone(), ..drawing.clone_without_curves() };
    Ok(scene_from_drawing(&empty, &SceneOptions { roles, ..scene_options(options) })?.report)
}

fn scene_options(options: &SectionOptions) -> SceneOptions {
    SceneOptions { join_tolerance_mm: options.join_tolerance_mm, ..SceneOptions::new(0.0) }
}

/// The shape as a part with its pole at the lower left corner of its box.
pub(super) fn at_pole(id: String, shape: &Polygon) -> Part {
    let pole = shape.bounds().min;
    let shape = shape.moved(&Motion::translation(-pole.coords));
    Part { id, shape, pole, rotation_rad: 0.0, mirrored: false }
}

/// Equal sections of one name become copies; others of one name are numbered.
fn counted(sections: Vec<Section>) -> Vec<Section> {
    let mut counted: Vec<Section> = Vec::new();
    let mut of_name: BTreeMap<String, Vec<usize>> = BTreeMap::new();
    for section in sections {
        let places = of_name.entry(section.id.clone()).or_default();
        if let Some(&place) = places.iter().find(|&&place| is_copy(&counted[place], &section)) {
            counted[place].quantity += 1;
            continue;
        }
        places.push(counted.len());
        counted.push(section);
    }
    for places in of_name.values().filter(|places| places.len() > 1) {
        for (number, &place) in places.iter().enumerate() {
            let id = format!("{}/{}", counted[place].id, number + 1);
            counted[place].id = id;
        }
    }
    let mut seen = std::collections::BTreeSet::new();
    for section in &mut counted {
        // A name may look like a numbered one.
        while !seen.insert(section.id.clone()) {
            section.id.push('\'');
        }
    }
    counted
}

/// Distance up to which two drawings of one block count as the same, millimetres.
const SAME_MM: f64 = 1e-6;

/// Whether both are the same but for their place along the strip.
fn is_copy(one: &Section, other: &Section) -> bool {
    let (from, to) = (one.bounds().min, other.bounds().min);
    let shift = to - from;
    let near = |a: Point, b: Point| (a - b).norm() <= SAME_MM;
    let same = |(a, b): (&Part, &Part)| {
        near(a.pole + shift, b.pole)
            && a.shape.rings().count() == b.shape.rings().count()
            && a.shape.rings().zip(b.shape.rings()).all(|(a, b)| {
                a.len() == b.len()
                    && a.vertices().iter().zip(b.vertices()).all(|(&a, &b)| near(a, b))
                    && a.bulges().len() == b.bulges().len()
                    && a.bulges().iter().zip(b.bulges()).all(|(a, b)| (a - b).abs() <= 1e-9)
            })
    };
    shift.y.abs() <= SAME_MM
        && one.parts.len() == other.parts.len()
        && one.parts.iter().zip(&other.parts).all(same)
}
