//! The way that a label stands for, from the start on.

use super::super::label::{Label, Step};
use super::AlongLinks;
use crate::search::{Ground, Route, Stop, Tangent, small_angle};
use traverse_geometry::Vector;

impl AlongLinks<'_> {
    /// The way from the start to the target's label `last`.
    pub(super) fn route(&self, last: &Label) -> Route {
        let mut stops = Vec::new();
        let mut after = *last;
        while !matches!(after.step, Step::FromStart) {
            let label = self.room.labels[after.from as usize];
            let circle = self.terrain.feature(label.feature());
            let sign = label.side().sign();
            let spoke = |direction: Option<Vector>, offset: f64| {
                direction.map_or_else(|| circle.direction_at(offset), |normal| -normal * sign)
            };
            let spoke_in = spoke(self.normal_before(&label), label.offset);
            let spoke_out = spoke(self.normal_before(&after), after.left_at);
            let in_by = small_angle(circle.direction_at(label.offset), spoke_in);
            let out_by = small_angle(circle.direction_at(after.left_at), spoke_out);
            let turned = ((after.left_at - label.offset + out_by - in_by) * sign).max(0.0);
            stops.push(Stop { circle: *circle, side: label.side(), spoke_in, spoke_out, turned });
            after = label;
        }
        stops.reverse();
        let places = [self.start.places[after.from as usize], self.target.places[last.place as usize]];
        Route { cost: last.cost, stops, places }
    }

    /// Left normal, on the answered path, of the straight move that leads to a label; none where there is none.
    fn normal_before(&self, label: &Label) -> Option<Vector> {
        if label.step == Step::Link {
            let from = &self.room.labels[label.from as usize];
            let (one, other) = (from.feature(), label.feature());
            let border =
                (from.side() == label.side()).then(|| self.terrain.along_border(one, other, label.side()));
            if let Some(border) = border.flatten() {
                return Some(border.normal);
            }
        }
        let signed = |label: &Label| {
            let circle = self.terrain.feature(label.feature());
            let sign = label.side().sign();
            (circle.center, circle.plan_radius * sign, circle.price_radius * sign)
        };
        let (c2, plan2, price2) = match label.step {
            Step::ToTarget => (self.target.point, 0.0, 0.0),
            _ => signed(label),
        };
        let before = || &self.room.labels[label.from as usize];
        let place = || self.target.places[label.place as usize];
        let (c1, plan1, price1) = match label.step {
            Step::Over => return None,
            Step::Guess | Step::Untested | Step::FromStart => (self.start.point, 0.0, 0.0),
            Step::Link | Step::ToTarget => signed(before()),
        };
        let price = Tangent::between(c1, price1, c2, price2).map(|price| price.normal);
        price.or_else(|| match label.step {
            Step::Guess | Step::Untested | Step::FromStart => {
                let from = self.start.places[label.from as usize];
                Tangent::between(from, 0.0, c2, plan2).map(|planned| planned.normal)
            }
            Step::ToTarget => Tangent::between(c1, plan1, place(), 0.0).map(|planned| planned.normal),
            Step::Link | Step::Over => Tangent::between(c1, plan1, c2, plan2).map(|planned| planned.normal),
        })
    }
}
