//! What was not used, counted by layer, element and reason.

use super::layers::Layers;
use crate::{Unused, WhyUnused};
use std::collections::BTreeMap;

/// Counts of what was not used.
#[derive(Debug, Default)]
pub(super) struct UnusedCount<'a> {
    counts: BTreeMap<(usize, &'a str, WhyUnused), usize>,
}

impl<'a> UnusedCount<'a> {
    /// One more, on the layer of that number.
    pub(super) fn add(&mut self, layer: usize, element: &'a str, why: WhyUnused) {
        *self.counts.entry((layer, element, why)).or_default() += 1;
    }

    /// The list, in order.
    pub(super) fn finished(self, layers: &Layers, unread_selectors: usize) -> Vec<Unused> {
        let unused = |((layer, element, why), count): ((usize, &str, WhyUnused), usize)| Unused {
            layer: layers.name(layer).to_owned(),
            entity: element.to_owned(),
            why,
            count,
        };
        let mut list: Vec<_> = self.counts.into_iter().map(unused).collect();
        if unread_selectors > 0 {
            let (layer, entity) = (String::new(), String::from("style"));
            list.push(Unused { layer, entity, why: WhyUnused::Selector, count: unread_selectors });
        }
        list.sort();
        list
    }
}
