//! One look for each layer: a colour that colour-blind eyes tell apart too, and a dash pattern for print.

/// Dark enough on white; after Okabe and Ito.
const COLORS: [&str; 7] = ["#0072b2", "#b34700", "#00785a", "#8a3d75", "#2b2b2b", "#8a6d00", "#2f7fb5"];
/// As many as are told apart at a glance. With the colours all pairs differ for 35 layers.
const DASHES: [&str; 5] = ["", "16 5", "3 4", "16 4 3 4", "8 4"];
/// Later layers have heavier lines in turn, as a third channel.
const WEIGHTS: [f64; 2] = [2.4, 3.2];

/// How the curves of a layer are drawn.
#[derive(Clone, Copy, Debug)]
pub(super) struct LayerStyle {
    color: &'static str,
    dash: &'static str,
    weight: f64,
}

impl LayerStyle {
    /// The look of the layer at that place in the drawing.
    pub(super) fn of(layer: usize) -> Self {
        let pick = |list: &[&'static str]| list.get(layer % list.len().max(1)).copied().unwrap_or("");
        let weight = WEIGHTS.get(layer / DASHES.len() % WEIGHTS.len()).copied().unwrap_or(2.4);
        Self { color: pick(&COLORS), dash: pick(&DASHES), weight }
    }

    /// Attributes of its lines.
    pub(super) fn stroke(self) -> String {
        let Self { color, dash, weight } = self;
        let dash = if dash.is_empty() { String::new() } else { format!(" stroke-dasharray=\"{dash}\"") };
        format!(" stroke=\"{color}\" stroke-width=\"{weight}\"{dash}")
    }

    /// Attributes of what its loops enclose.
    pub(super) fn fill(self) -> String {
        format!(" fill=\"{}\"", self.color)
    }
}
