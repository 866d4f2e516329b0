//! In which order, and in which pose, the sections of a cutting layout join tightest: exact joins, true lengths, lower
//! bounds always and mostly a proof.

mod answer;
mod certificate;
mod contact;
mod curve;
mod envelope;
mod grid;
mod instance;
mod join;
mod join_matrix;
mod layout;
mod meeting;
mod offsets;
mod options;
mod outline;
mod placing;
mod profile;
mod published_effect;

pub use answer::{Ending, LayoutAnswer, LayoutPlan};
pub use certificate::{BoundCertificate, JoinDuals};
pub use contact::Contact;
pub use join::{Join, join};
pub use join_matrix::{JoinItem, JoinMatrix, joins};
pub use layout::{contacts, layout_length_mm, place, place_as_published};
pub use options::{Algorithm, EffectModel, InnerOverlap, OrderOptions};
pub use published_effect::published_effect;

use traverse_geometry::{Finding, SectionLayout};
use traverse_solve::{Budget, Interrupt, Observer};

/// Orders the sections of a layout.
///
/// # Errors
/// Everything that is wrong with the question, as [`layout_findings`] says; none when the budget ends meanwhile.
pub fn order_sections(
    layout: &SectionLayout,
    options: &OrderOptions,
    budget: &Budget,
    observer: &mut dyn Observer,
) -> Result<LayoutAnswer, Vec<Finding>> {
    let _ = (layout, options, budget, observer);
    Err(vec![])
}

/// Everything that is wrong with a question; none for one that [`order_sections`] takes. Fields are relative to the
/// request: `sections[3].quantity`, `gap_mm`, `first_section_id`, `precedences[1].before_section_id`,
/// `forbidden_joins[0].left_section_id`, `initial_order[2].section_id`.
///
/// # Errors
/// When the budget ends first: looking for parts that overlap can take long.
pub fn layout_findings(
    layout: &SectionLayout,
    options: &OrderOptions,
    budget: &Budget,
) -> Result<Vec<Finding>, Interrupt> {
    let _ = (layout, options, budget);
    Ok(vec![])
}

