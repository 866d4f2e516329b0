//! Through the tree of elements, uses followed, every shape on its layer.

use super::affine::Affine;
use super::budget::Budget;
use super::curve::{Refused, curve_of};
use super::element::{Element, LengthContext};
use super::layers::Layers;
use super::properties::Properties;
use super::shapes::{SHAPES, outlines};
use super::style::Style;
use super::style_sheet::StyleSheet;
use super::transform::transform;
use super::unused_count::UnusedCount;
use super::viewport::{into_box, view_box};
use crate::{Curve, DrawnGroup, ReadError, ReadOptions, Source, WhyUnused};
use roxmltree::NodeId;
use std::collections::HashMap;
use std::sync::Arc as Shared;
use traverse_geometry::COORDINATE_LIMIT_MM;

/// Elements may be nested this deep, uses included.
const DEEPEST: usize = 256;

/// Elements that draw nothing where they stand.
const NOT_DRAWN: [&str; 26] = [
    "animate",
    "animateColor",
    "animateMotion",
    "animateTransform",
    "clipPath",
    "color-profile",
    "cursor",
    "defs",
    "desc",
    "filter",
    "font",
    "font-face",
    "hatch",
    "linearGradient",
    "marker",
    "mask",
    "meshgradient",
    "metadata",
    "pattern",
    "radialGradient",
    "script",
    "set",
    "style",
    "symbol",
    "title",
    "view",
];

/// Elements that write; `flowRoot` is an older Inkscape's.
const TEXT: [&str; 2] = ["text", "flowRoot"];

/// Elements that only hold others.
const GROUPS: [&str; 4] = ["g", "a", "svg", "switch"];

/// What an element takes over from those around it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Surroundings {
    pub(super) to_mm: Affine,
    pub(super) lengths: LengthContext,
    pub(super) style: Style,
    /// Whether an element around is not displayed.
    pub(super) hidden: bool,
    /// Number of the layer.
    pub(super) layer: usize,
    pub(super) layer_from: LayerFrom,
}

/// What gave the layer its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum LayerFrom {
    /// Nothing: layer `0`.
    Nothing,
    /// The outermost group with an id.
    Group,
    /// A layer of Inkscape.
    Inkscape,
}

/// The state of the walk.
pub(super) struct Walk<'a> {
    pub(super) options: &'a ReadOptions,
    pub(super) budget: Budget,
    pub(super) sheet: StyleSheet<'a>,
    pub(super) ids: HashMap<&'a str, Element<'a>>,
    pub(super) layers: Layers,
    pub(super) unused: UnusedCount<'a>,
    /// Names of the groups around.
    pub(super) groups: Vec<&'a str>,
    /// The outermost of them that is no layer.
    pub(super) drawn_group: Option<DrawnGroup>,
    /// How many such groups there were.
    pub(super) groups_drawn: u32,
    /// What the uses around refer to.
    pub(super) uses: Vec<NodeId>,
}

impl<'a> Walk<'a> {
    /// Takes all that the outermost element draws. Its size is the page's: that is in the surroundings already.
    pub(super) fn outermost(&mut self, root: Element<'a>, around: &Surroundings) -> Result<(), ReadError> {
        let mut here = *around;
        self.budget.bytes(root.attribute_bytes())?;
        let looks = self.take_looks(&root, &mut here)?;
        if looks.is_clipped() {
            self.unused.add(here.layer, root.tag(), WhyUnused::Clipped);
        }
        here.to_mm = here.to_mm.after(&transform(&root, &looks, &here.lengths)?);
        self.children(&root, &here, 1)
    }

    /// Takes what an element and those inside it draw.
    pub(super) fn element(
        &mut self,
        element: Element<'a>,
        around: &Surroundings,
        depth: usize,
    ) -> Result<(), ReadError> {
        let tag = element.tag();
        self.budget.element()?;
        if NOT_DRAWN.contains(&tag) {
            return Ok(());
        }
        if depth > DEEPEST {
            return Err(ReadError::TooDeep { limit: DEEPEST, line: element.line() });
        }
        self.budget.bytes(element.attribute_bytes())?;
        let mut here = *around;
        let looks = self.take_looks(&element, &mut here)?;
        let draws = SHAPES.contains(&tag);
        if !draws && !GROUPS.contains(&tag) && tag != "use" {
            let why = if !here.is_seen() {
                WhyUnused::Hidden
            } else if TEXT.contains(&tag) {
                WhyUnused::Annotation
            } else {
                WhyUnused::Type
            };
            self.unused.add(here.layer, tag, why);
            return Ok(());
        }
        if here.hidden && tag == "use" || draws && !here.is_seen() {
            self.unused.add(here.layer, tag, WhyUnused::Hidden);
            return Ok(());
        }
        if looks.is_clipped() && !here.hidden {
            self.unused.add(here.layer, tag, WhyUnused::Clipped);
        }
        here.to_mm = here.to_mm.after(&transform(&element, &looks, &here.lengths)?);
        match tag {
            "use" => self.used(&element, here, depth),
            "svg" => self.page(&element, None, here, depth),
            _ if draws => self.shape(&element, &here),
            _ => self.group(&element, here, depth),
        }
    }

    /// Reads the style of an element, for what is inside it too; gives what is said of the element itself.
    fn take_looks(
        &mut self,
        element: &Element<'a>,
        here: &mut Surroundings,
    ) -> Result<Properties<'a>, ReadError> {
        let (properties, bytes) = Properties::of(element, &self.sheet);
        self.budget.bytes(bytes)?;
        here.style = here.style.of_child(&properties);
        here.hidden |= properties.display == Some("none");
        Ok(properties)
    }

    /// A group and what is inside it.
    fn group(&mut self, group: &Element<'a>, mut here: Surroundings, depth: usize) -> Result<(), ReadError> {
        let name = group.label().or_else(|| group.id());
        if group.tag() == "g" {
            if let (true, Some(name)) = (group.is_inkscape_layer(), name) {
                (here.layer, here.layer_from) = (self.layers.number(name), LayerFrom::Inkscape);
            } else if let (LayerFrom::Nothing, Some(id)) = (here.layer_from, group.id()) {
                (here.layer, here.layer_from) = (self.layers.number(id), LayerFrom::Group);
            }
        }
        let around = self.drawn_group;
        if !(group.tag() == "g" && group.is_inkscape_layer()) {
            self.enter(name);
        }
        self.groups.extend(name);
        self.children(group, &here, depth)?;
        self.groups.truncate(self.groups.len() - usize::from(name.is_some()));
        self.drawn_group = around;
        Ok(())
    }

    /// Notes the outermost group that has a name.
    fn enter(&mut self, name: Option<&str>) {
        if name.is_some() && self.drawn_group.is_none() {
            self.drawn_group = Some(DrawnGroup { number: self.groups_drawn, place: self.groups.len() });
            self.groups_drawn += 1;
        }
    }

    fn children(&mut self, parent: &Element<'a>, here: &Surroundings, depth: usize) -> Result<(), ReadError> {
        let only_one = if parent.tag() == "switch" { 1 } else { usize::MAX };
        let fits = |child: &Element<'_>| only_one > 1 || is_chosen(child);
        for child in parent.children().filter(fits).take(only_one) {
            self.element(child, here, depth + 1)?;
        }
        Ok(())
    }

    /// A page within the page, of the size that the use of it asks for.
    fn page(
        &mut self,
        page: &Element<'a>,
        used_by: Option<&Element<'a>>,
        mut here: Surroundings,
        depth: usize,
    ) -> Result<(), ReadError> {
        let outer = here.lengths;
        let size = |name, whole| -> Result<f64, ReadError> {
            let asked = used_by.map_or(Ok(None), |used_by| used_by.length_if_any(name, &outer))?;
            Ok(asked.or(page.length_if_any(name, &outer)?).unwrap_or(whole))
        };
        let size = (size("width", outer.width)?, size("height", outer.height)?);
        let drawn = size.0 > 0.0 && size.1 > 0.0;
        let corner = Affine::translation(page.length("x", &outer)?, page.length("y", &outer)?);
        here.to_mm = here.to_mm.after(&corner);
        if let Some(view) = view_box(page)? {
            // A page without size draws nothing.
            if !drawn {
                return Ok(());
            }
            here.to_mm = here.to_mm.after(&into_box(page, &view, size)?);
            (here.lengths.width, here.lengths.height) = (view.w, view.h);
        } else {
            (here.lengths.width, here.lengths.height) = size;
        }
        self.children(page, &here, depth)
    }

    /// What a `use` refers to, drawn here.
    fn used(&mut self, user: &Element<'a>, mut here: Surroundings, depth: usize) -> Result<(), ReadError> {
        let reference = user.reference();
        let Some(&target) = self.ids.get(reference) else {
            self.unused.add(here.layer, user.tag(), WhyUnused::Reference);
            return Ok(());
        };
        if self.uses.contains(&target.node.id()) {
            let reference = reference.chars().take(40).collect();
            return Err(ReadError::UseCycle { line: user.line(), reference });
        }
        let corner = Affine::translation(user.length("x", &here.lengths)?, user.length("y", &here.lengths)?);
        here.to_mm = here.to_mm.after(&corner);
        let name = user.label().or_else(|| user.id());
        let around = self.drawn_group;
        self.enter(name);
        self.groups.extend(name);
        self.uses.push(target.node.id());
        if matches!(target.tag(), "symbol" | "svg") {
            self.budget.element()?;
            self.budget.bytes(target.attribute_bytes())?;
            if depth >= DEEPEST {
                return Err(ReadError::TooDeep { limit: DEEPEST, line: user.line() });
            }
            let looks = self.take_looks(&target, &mut here)?;
            if looks.is_clipped() {
                self.unused.add(here.layer, target.tag(), WhyUnused::Clipped);
            }
            here.to_mm = here.to_mm.after(&transform(&target, &looks, &here.lengths)?);
            self.page(&target, Some(user), here, depth + 1)?;
        } else {
            self.element(target, &here, depth + 1)?;
        }
        self.uses.pop();
        self.groups.truncate(self.groups.len() - usize::from(name.is_some()));
        self.drawn_group = around;
        Ok(())
    }

    /// A shape, subpath by subpath.
    fn shape(&mut self, shape: &Element<'a>, here: &Surroundings) -> Result<(), ReadError> {
        let names = self.groups.iter().map(|name| name.len() + size_of::<String>()).sum();
        self.budget.bytes(names)?;
        let source = Shared::new(Source {
            id: shape.id().map(str::to_owned),
            groups: self.groups.iter().map(|&name| name.to_owned()).collect(),
            drawn_group: self.drawn_group,
            color: here.style.drawn_color(),
        });
        let mut drawn = false;
        for outline in outlines(shape, &here.lengths)? {
            let tolerance_mm = self.options.fit_tolerance_mm;
            match curve_of(&outline, &here.to_mm, tolerance_mm, &mut self.budget) {
                Ok(None) => {}
                Ok(Some(curve)) => {
                    drawn = true;
                    self.layers.add(here.layer, Curve { source: source.clone(), ..curve });
                }
                Err(Refused::Limit(error)) => return Err(error),
                Err(Refused::OutOfRange(value)) => {
                    let problem = format!("outside ±{COORDINATE_LIMIT_MM} mm");
                    return Err(shape.bad("a coordinate", &format!("{value} mm"), problem));
                }
            }
        }
        if !drawn {
            self.unused.add(here.layer, shape.tag(), WhyUnused::NoLength);
        }
        Ok(())
    }
}

impl Surroundings {
    fn is_seen(&self) -> bool {
        self.style.visible && !self.hidden
    }
}

/// Whether a `switch` would choose this element: it asks for no extension and no language but English.
fn is_chosen(element: &Element<'_>) -> bool {
    let extensions = element.attribute("requiredExtensions").unwrap_or_default();
    let language = element.attribute("systemLanguage");
    extensions.trim().is_empty()
        && language.is_none_or(|list| list.split(',').any(|name| name.trim().starts_with("en")))
}
