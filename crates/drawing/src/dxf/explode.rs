//! Blocks drawn out: every entity of the model as a curve where it comes to lie.
//!
//! Blocks within blocks are kept on a stack of our own, so any depth will do. Totals are checked before: see
//! [`super::totals`].

use super::affine::Affine;
use super::blocks::{Block, MODEL};
use super::budget::VertexBudget;
use super::entity::{Entity, Kind};
use super::file::File;
use super::insert::Insert;
use super::layers::LayerId;
use super::outline::Outline;
use super::record::ColorRule;
use crate::{Color, Curve, DrawnGroup, Layer, ReadError, ReadOptions, Source, Unused, WhyUnused};
use std::collections::BTreeMap;
use std::sync::Arc as Shared;

/// White or black, whichever shows: the colour of what takes its colour from a block but stands in none.
const NEUTRAL: Color = Color { red: 255, green: 255, blue: 255 };

/// What a name takes beside its letters, bytes.
const NAME_BYTES: u64 = 24;

/// Layers with their curves, in the order of their first entity, and what was not used. Lengths are multiplied by
/// `millimetres`.
pub(super) fn explode(
    file: &File<'_>,
    millimetres: f64,
    options: &ReadOptions,
) -> Result<(Vec<Layer>, Vec<Unused>), ReadError> {
    let mut explosion = Explosion {
        file,
        options,
        budget: VertexBudget::new(options.vertex_limit),
        names_left: options.byte_limit,
        groups_drawn: 0,
        layers: Vec::new(),
        places: vec![None; file.layers.count()],
        unused: BTreeMap::new(),
    };
    explosion.run(Affine::scaling(millimetres, millimetres))?;
    let Explosion { layers, unused, .. } = explosion;
    let unused = unused.into_iter().map(|((layer, entity, why), count)| {
        let layer = file.layers.name(layer).to_owned();
        Unused { layer, entity: entity.to_owned(), why, count }
    });
    let mut unused: Vec<Unused> = unused.collect();
    unused.sort();
    Ok((layers, unused))
}

/// A block that is being drawn.
struct Frame<'f> {
    block: &'f Block,
    /// Its next entity.
    next: usize,
    /// From its coordinates to the drawing.
    map: Affine,
    /// Where the things on layer 0 come to lie.
    layer: Option<LayerId>,
    /// What is coloured by its block gets this colour.
    color: Option<Color>,
    /// What draws it, the map around that, and the copy that is being drawn; none for the model.
    insert: Option<(&'f Insert, Affine, u64)>,
}

struct Explosion<'f> {
    file: &'f File<'f>,
    options: &'f ReadOptions,
    budget: VertexBudget,
    names_left: u64,
    /// Blocks drawn so far that stand in no other.
    groups_drawn: u32,
    layers: Vec<Layer>,
    /// Of each layer its place in `layers`.
    places: Vec<Option<usize>>,
    unused: BTreeMap<(LayerId, &'f str, WhyUnused), usize>,
}

impl<'f> Explosion<'f> {
    fn run(&mut self, map: Affine) -> Result<(), ReadError> {
        let block = self.file.blocks.get(MODEL);
        let mut stack = vec![Frame { block, next: 0, map, layer: None, color: Some(NEUTRAL), insert: None }];
        let mut groups: Vec<&'f str> = Vec::new();
        while let Some(frame) = stack.last_mut() {
            let block = frame.block;
            let Some(entity) = block.entities.get(frame.next) else {
                if !frame.next_copy() {
                    stack.pop();
                    groups.pop();
                } else if groups.len() == 1 {
                    self.groups_drawn += 1;
                }
                continue;
            };
            frame.next += 1;
            let (layer, color) = self.appearance(entity, frame);
            match &entity.kind {
                Kind::Insert(insert) if self.file.blocks.get(insert.block).known => {
                    let block = self.file.blocks.get(insert.block);
                    let around = frame.map;
                    let map = around.after(&insert.placement(0, block.base));
                    let insert = Some((&**insert, around, 0));
                    stack.push(Frame { block, next: 0, map, layer: Some(layer), color, insert });
                    self.groups_drawn += u32::from(groups.is_empty());
                    groups.push(&block.name);
                }
                Kind::Insert(_) => self.count(layer, "INSERT", WhyUnused::UnknownBlock),
                Kind::Shape(name, shape) => {
                    let mut outline = Outline {
                        map: &frame.map,
                        entity: name,
                        line: entity.line,
                        layer: self.file.layers.name(layer),
                        tolerance_mm: self.options.fit_tolerance_mm,
                        budget: &mut self.budget,
                    };
                    match outline.curve(shape)? {
                        None => self.count(layer, name, WhyUnused::NoLength),
                        Some(curve) => {
                            let source = self.source(entity, &groups, color)?;
                            self.keep(layer, Curve { source: Shared::new(source), ..curve });
                            if let Some(why) = shape.not_shown() {
                                self.count(layer, name, why);
                            }
                        }
                    }
                }
                Kind::Unused(name, why) => self.count(layer, name, *why),
                Kind::Hatch(_) => self.count(layer, "HATCH", WhyUnused::Type),
            }
        }
        Ok(())
    }

    /// The layer that an entity comes to lie on, and its colour.
    fn appearance(&self, entity: &Entity, frame: &Frame<'_>) -> (LayerId, Option<Color>) {
        let layer = match frame.layer {
            Some(layer) if Some(entity.layer) == self.file.layers.zero() => layer,
            _ => entity.layer,
        };
        let color = match entity.color {
            ColorRule::ByLayer => self.file.layers.color(layer),
            ColorRule::ByBlock => frame.color,
            ColorRule::Own(color) => color,
        };
        (layer, color)
    }

    fn source(
        &mut self,
        entity: &Entity,
        groups: &[&str],
        color: Option<Color>,
    ) -> Result<Source, ReadError> {
        let bytes: u64 = groups.iter().map(|name| NAME_BYTES + name.len() as u64).sum();
        let limit = self.options.byte_limit;
        self.names_left = self.names_left.checked_sub(bytes).ok_or(ReadError::TooMuchNesting { limit })?;
        let groups: Vec<String> = groups.iter().map(|&name| name.to_owned()).collect();
        let number = self.groups_drawn.saturating_sub(1);
        let drawn_group = (!groups.is_empty()).then_some(DrawnGroup { number, place: 0 });
        Ok(Source { id: entity.handle.map(|handle| format!("{handle:X}")), groups, drawn_group, color })
    }

    fn keep(&mut self, layer: LayerId, curve: Curve) {
        let place = *self.places[layer.index()].get_or_insert_with(|| {
            let name = self.file.layers.name(layer).to_owned();
            self.layers.push(Layer { name, curves: Vec::new() });
            self.layers.len() - 1
        });
        self.layers[place].curves.push(curve);
    }

    fn count(&mut self, layer: LayerId, entity: &'f str, why: WhyUnused) {
        *self.unused.entry((layer, entity, why)).or_default() += 1;
    }
}

impl Frame<'_> {
    /// Goes on to the next copy of an array; false when there is none.
    fn next_copy(&mut self) -> bool {
        let Some((insert, around, copy)) = &mut self.insert else { return false };
        *copy += 1;
        if *copy >= insert.copies() {
            return false;
        }
        self.map = around.after(&insert.placement(*copy, self.block.base));
        self.next = 0;
        true
    }
}
