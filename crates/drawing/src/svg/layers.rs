//! Layers by name, upper and lower case alike, in the order of their first curve.

use crate::{Curve, Layer};
use std::collections::HashMap;

/// Layers, those without curves included, by number.
#[derive(Debug, Default)]
pub(super) struct Layers {
    list: Vec<Layer>,
    numbers: HashMap<String, usize>,
    with_curves: Vec<usize>,
}

impl Layers {
    /// The number of the layer of that name.
    pub(super) fn number(&mut self, name: &str) -> usize {
        let next = self.list.len();
        let number = *self.numbers.entry(name.to_lowercase()).or_insert(next);
        if number == next {
            self.list.push(Layer { name: name.to_owned(), curves: Vec::new() });
        }
        number
    }

    pub(super) fn add(&mut self, number: usize, curve: Curve) {
        if let Some(layer) = self.list.get_mut(number) {
            if layer.curves.is_empty() {
                self.with_curves.push(number);
            }
            layer.curves.push(curve);
        }
    }

    pub(super) fn name(&self, number: usize) -> &str {
        self.list.get(number).map_or("", |layer| layer.name.as_str())
    }

    /// Those with curves.
    pub(super) fn finished(mut self) -> Vec<Layer> {
        let take = |&number: &usize| self.list.get_mut(number).map(std::mem::take);
        self.with_curves.iter().filter_map(take).collect()
    }
}
