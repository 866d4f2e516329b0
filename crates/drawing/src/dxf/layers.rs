//! Layers of a file: their names and colours.

use super::record::ColorRule;
use super::text::TextCoding;
use crate::Color;
use std::collections::HashMap;

/// A layer by its place in [`Layers`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) struct LayerId(u32);

/// Layers by name. Names that differ in case only are one layer.
#[derive(Debug, Default)]
pub(super) struct Layers<'a> {
    /// As first written.
    names: Vec<String>,
    colors: Vec<Option<Color>>,
    /// By their bytes in the file, so that a name is decoded once.
    by_bytes: HashMap<&'a [u8], LayerId>,
    /// By their letters in lower case.
    by_letters: HashMap<String, LayerId>,
}

impl LayerId {
    /// Its place among all layers.
    pub(super) fn index(self) -> usize {
        self.0 as usize
    }
}

impl<'a> Layers<'a> {
    /// The layer of that name, new if need be.
    pub(super) fn id_of(&mut self, name: &'a [u8], coding: TextCoding) -> LayerId {
        if let Some(&id) = self.by_bytes.get(name) {
            return id;
        }
        let text = coding.decode(name);
        let next = LayerId(self.names.len() as u32);
        let id = *self.by_letters.entry(text.to_lowercase()).or_insert(next);
        if id == next {
            self.names.push(text);
            self.colors.push(None);
        }
        self.by_bytes.insert(name, id);
        id
    }

    /// Layer 0, if the file speaks of it: what is drawn on it in a block comes to lie on the INSERT's layer.
    pub(super) fn zero(&self) -> Option<LayerId> {
        self.by_letters.get("0").copied()
    }

    /// How many there are.
    pub(super) fn count(&self) -> usize {
        self.names.len()
    }

    /// Notes the colour that the layer table gives.
    pub(super) fn set_color(&mut self, id: LayerId, rule: ColorRule) {
        if let ColorRule::Own(color) = rule {
            self.colors[id.index()] = color;
        }
    }

    /// Its name as first written.
    pub(super) fn name(&self, id: LayerId) -> &str {
        &self.names[id.index()]
    }

    /// Its colour, if the file says.
    pub(super) fn color(&self, id: LayerId) -> Option<Color> {
        self.colors[id.index()]
    }
}
