//! What was read from a file, whatever its format: layers of curves in millimetres.

use crate::{Curve, LengthUnit, PageMapping, Unused};

/// A drawing in millimetres, layer by layer, with what could not be used.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    /// Unit of the file. Everything here is converted to millimetres already.
    pub unit: LengthUnit,
    /// Whether the file left its unit open and `unit` is the assumed default.
    pub unit_assumed: bool,
    /// Layers that hold at least one entity, in the order of their first entity.
    pub layers: Vec<Layer>,
    /// What could not be used, by layer, entity type and reason.
    pub unused: Vec<Unused>,
    /// How the file's coordinates became millimetres, for formats that have a page: SVG.
    pub mapping: Option<PageMapping>,
}

/// A layer and the curves on it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layer {
    /// As first written in the file. Names that differ in case only are one layer, as in CAD programs.
    pub name: String,
    /// In file order.
    pub curves: Vec<Curve>,
}

impl Drawing {
    /// The same unit and page without layers and without what could not be used.
    pub(crate) fn clone_without_curves(&self) -> Self {
        Self {
            unit: self.unit,
            unit_assumed: self.unit_assumed,
            layers: Vec::new(),
            unused: Vec::new(),
            mapping: self.mapping,
        }
    }

    /// Count of curves on all layers.
    #[must_use]
    pub fn curve_count(&self) -> usize {
        self.layers.iter().map(|layer| layer.curves.len()).sum()
    }

    /// The layer of that name, upper and lower case alike.
    #[must_use]
    pub fn layer(&self, name: &str) -> Option<&Layer> {
        let name = name.to_lowercase();
        self.layers.iter().find(|layer| layer.name.to_lowercase() == name)
    }
}
