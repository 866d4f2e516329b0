//! From drawings and part sets to the sections of a layout, with everything that was not used said.

use crate::arguments::Unit;
use crate::failure::Failure;
use crate::input;
use crate::order_arguments::{Order, PoseChoice, SectionsChoice, Slide};
use std::path::Path;
use traverse_drawing::{
    BlockRules, LengthUnit, ReadOptions, SectionOptions, SectionsBy, Selector, build_blocks, read_drawing,
    read_part_set, sections_from_drawing,
};
use traverse_geometry::{Pose, Section, SectionLayout, SlideRule};

/// The layout that the files and the command line ask for.
pub(crate) fn layout(arguments: &Order) -> Result<SectionLayout, Failure> {
    let mut sections = Vec::new();
    let mut strip_height_mm = arguments.strip_height;
    for file in &arguments.files {
        let (mut read, height) = sections_of(file, arguments)?;
        if arguments.files.len() > 1 {
            // Files may call different sections by the same name.
            let stem = file.file_stem().unwrap_or_default().to_string_lossy();
            read.iter_mut().for_each(|section| section.id = format!("{stem}:{}", section.id));
        }
        sections.append(&mut read);
        strip_height_mm = strip_height_mm.or(height);
    }
    for (id, count) in &arguments.copies {
        let place = named(&sections, id)?;
        sections[place].quantity = *count;
    }
    let place = |id: &String| named(&sections, id);
    let pairs = |pairs: &[(String, String)]| -> Result<Vec<(usize, usize)>, Failure> {
        pairs.iter().map(|(one, other)| Ok((place(one)?, place(other)?))).collect()
    };
    Ok(SectionLayout {
        gap_mm: arguments.gap,
        strip_height_mm,
        first: arguments.first.as_ref().map(place).transpose()?,
        last: arguments.last.as_ref().map(place).transpose()?,
        precedences: pairs(&arguments.before)?,
        forbidden_joins: pairs(&arguments.forbid)?,
        slide_rule: match arguments.slide {
            Slide::KeepOrder => SlideRule::KeepOrder,
            Slide::Free => SlideRule::Free,
        },
        sections,
    })
}

fn named(sections: &[Section], id: &str) -> Result<usize, Failure> {
    sections.iter().position(|section| section.id == id).ok_or_else(|| {
        let mut known: Vec<&str> = sections.iter().map(|section| section.id.as_str()).take(20).collect();
        if sections.len() > known.len() {
            known.push("…");
        }
        Failure::Input(format!("there is no section {id}; choose one of {}", known.join(", ")))
    })
}

/// The sections of a file, and the height of its strip, if it names one.
fn sections_of(file: &Path, arguments: &Order) -> Result<(Vec<Section>, Option<f64>), Failure> {
    let bytes = input::read(file)?;
    let is_json = file.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("json"))
        || bytes.trim_ascii_start().first() == Some(&b'{');
    if is_json { blocks(file, &bytes, arguments) } else { drawn(file, &bytes, arguments) }
}

fn blocks(file: &Path, bytes: &[u8], arguments: &Order) -> Result<(Vec<Section>, Option<f64>), Failure> {
    let wrong =
        |error: traverse_drawing::PartSetError| Failure::Input(format!("{}: {error}", file.display()));
    let mut set = read_part_set(bytes).map_err(wrong)?;
    set.strip_height_mm = arguments.strip_height.unwrap_or(set.strip_height_mm);
    let rules = BlockRules {
        columns: arguments.columns,
        count: arguments.blocks,
        gap_mm: arguments.gap.max(0.0),
        seed: arguments.seed.into(),
        poses: poses(arguments),
    };
    let sections = build_blocks(&set, &rules).map_err(wrong)?;
    let pieces: usize = sections.iter().map(|section| section.parts.len()).sum();
    eprintln!(
        "{}: {pieces} pieces in {} blocks of at most {} mm",
        file.display(),
        sections.len(),
        set.strip_height_mm
    );
    Ok((sections, Some(set.strip_height_mm)))
}

fn drawn(file: &Path, bytes: &[u8], arguments: &Order) -> Result<(Vec<Section>, Option<f64>), Failure> {
    let name = file.display();
    let mut options = ReadOptions::default();
    options.default_unit = match arguments.unit {
        Unit::Mm => LengthUnit::MILLIMETRES,
        Unit::Inch => LengthUnit::INCHES,
    };
    options.pixels_per_inch = arguments.dpi;
    options.fit_tolerance_mm = arguments.fit;
    let drawing =
        read_drawing(bytes, &options).map_err(|error| Failure::Input(format!("{name}: {error}")))?;
    let mut options = SectionOptions {
        by: match arguments.sections {
            SectionsChoice::Found => SectionsBy::Found,
            SectionsChoice::Group | SectionsChoice::Block => SectionsBy::Group,
            SectionsChoice::Layer => SectionsBy::Layer,
            SectionsChoice::Part => SectionsBy::Part,
        },
        join_tolerance_mm: arguments.join,
        poses: poses(arguments),
        ..SectionOptions::default()
    };
    if !arguments.ignore.is_empty() {
        options.ignored = arguments.ignore.iter().map(|text| Selector::new(text)).collect();
    }
    let made = sections_from_drawing(&drawing, &options)
        .map_err(|error| Failure::Input(format!("{name}: {error}")))?;
    eprint!("{}", made.report);
    eprintln!("{name}: {} sections, each a {}", made.sections.len(), made.by.name());
    if made.outside_count > 0 {
        eprintln!("{name}: {} curves belong to no {}", made.outside_count, made.by.name());
    }
    for id in &made.empty {
        eprintln!("{name}: {id} holds no closed outline");
    }
    if !made.is_complete() && !arguments.ignore_unused {
        return Err(Failure::Input(format!(
            "{name}: parts of it could not be used (see above); look at them with `traverse inspect {name} -o drawing.svg`, \
             repair the drawing, leave them out with --ignore, or pass --ignore-unused"
        )));
    }
    Ok((made.sections, None))
}

/// The poses that every section may have.
fn poses(arguments: &Order) -> Vec<Pose> {
    let mut poses: Vec<Pose> = Vec::new();
    for choice in &arguments.poses {
        let pose = match choice {
            PoseChoice::AsIs => Pose::AsIs,
            PoseChoice::HalfTurn => Pose::HalfTurn,
            PoseChoice::MirrorX => Pose::MirrorX,
            PoseChoice::MirrorY => Pose::MirrorY,
        };
        if !poses.contains(&pose) {
            poses.push(pose);
        }
    }
    poses
}
