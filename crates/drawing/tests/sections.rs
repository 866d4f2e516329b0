//! Sections from drawings and part sets, and what is written of layouts.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

use traverse_drawing::{
    BlockRules, PartSetError, ReadOptions, SectionOptions, SectionsBy, SectionsError, SectionsFromDrawing,
    Selector, ShownLayout, build_blocks, picture_of_layout, png_of_svg, read_drawing, read_dxf,
    read_part_set, sections_from_drawing, write_layout_dxf,
};
use traverse_geometry::{PlacedSection, Point, Pose, Section, SectionLayout, SlideRule};

fn made(text: &str, by: SectionsBy) -> SectionsFromDrawing {
    let drawing = read_drawing(text.as_bytes(), &ReadOptions::default()).unwrap();
    sections_from_drawing(&drawing, &SectionOptions { by, ..SectionOptions::default() }).unwrap()
}

fn ids(made: &SectionsFromDrawing) -> Vec<(&str, u32, usize)> {
    made.sections.iter().map(|section| (section.id.as_str(), section.quantity, section.parts.len())).collect()
}

const SVG: &str = r#"<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"
    width="300mm" height="100mm" viewBox="0 0 300 100">
  <g id="WORK_AREA"><rect width="300" height="100"/></g>
  <g inkscape:groupmode="layer" id="layer1" inkscape:label="Cuts">
    <g id="right"><rect x="100" y="10" width="40" height="80"/><circle cx="120" cy="50" r="10"/></g>
    <g id="left"><rect x="10" y="10" width="40" height="30"/><g id="inner"><rect x="10" y="50" width="40" height="30"/></g></g>
    <g inkscape:label="twin"><rect x="200" y="0" width="20" height="20"/></g>
    <g inkscape:label="twin"><rect x="230" y="0" width="20" height="20"/></g>
    <g inkscape:label="twin"><rect x="260" y="0" width="20" height="30"/></g>
  </g>
</svg>"#;

#[test]
fn groups_of_an_svg_file_are_sections_from_left_to_right() {
    let made = made(SVG, SectionsBy::Found);
    assert_eq!(made.by, SectionsBy::Group);
    assert_eq!(ids(&made), [("left", 1, 2), ("right", 1, 1), ("twin/1", 2, 1), ("twin/2", 1, 1)]);
    assert!(made.is_complete(), "{}", made.report);
    let right = &made.sections[1].parts[0];
    assert_eq!((right.pole, right.shape.holes().len()), (Point::new(100.0, 10.0), 1));
    assert_eq!(made.sections[0].bounds().size().y, 70.0);
}

#[test]
fn layers_and_parts_may_be_sections_too() {
    let by_layer = made(SVG, SectionsBy::Layer);
    assert_eq!(ids(&by_layer), [("Cuts", 1, 6)]);
    let by_part = made(SVG, SectionsBy::Part);
    assert_eq!(by_part.sections.len(), 6);
    assert!(by_part.sections.iter().all(|section| section.parts.len() == 1));
    let plain = "<svg xmlns='http://www.w3.org/2000/svg' width='50mm' height='50mm' viewBox='0 0 50 50'>\
                 <rect width='10' height='10'/><rect x='20' width='10' height='20'/></svg>";
    assert_eq!(made(plain, SectionsBy::Found).by, SectionsBy::Part);
}

#[test]
fn what_is_in_no_group_and_what_is_not_closed_is_said() {
    let text = SVG.replace(
        "<g id=\"WORK_AREA\">",
        "<path d='M0 0H9'/><g id='open'><path d='M0 0H9V9'/></g><g id=\"WORK_AREA\">",
    );
    let made = made(&text, SectionsBy::Group);
    assert_eq!((made.outside_count, made.empty.as_slice()), (1, &["open".to_owned()][..]));
    assert!(!made.is_complete());
    assert!(made.report.to_string().contains("open chain"), "{}", made.report);
    let drawing = read_drawing(text.as_bytes(), &ReadOptions::default()).unwrap();
    let all = SectionOptions { ignored: vec![Selector::new("*")], ..SectionOptions::default() };
    let none = sections_from_drawing(&drawing, &all).unwrap_err();
    assert!(matches!(none, SectionsError::None { .. }) && none.to_string().contains("--sections"), "{none}");
}

/// A block with a square and a hole, inserted at these places; the second number is a rotation in degrees.
fn blocks(places: &[(f64, f64)]) -> String {
    let mut text = String::from("0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nNEST\n10\n0\n20\n0\n");
    for (x0, side) in [(0.0, 30.0), (10.0, 5.0)] {
        text += "0\nLWPOLYLINE\n8\nCUT\n90\n4\n70\n1\n";
        for (x, y) in [(x0, x0), (x0 + side, x0), (x0 + side, x0 + side), (x0, x0 + 0.5 * side)] {
            text += &format!("10\n{x}\n20\n{y}\n");
        }
    }
    text += "0\nENDBLK\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n";
    for (x, turn) in places {
        text += &format!("0\nINSERT\n8\n0\n2\nNEST\n10\n{x}\n20\n0\n50\n{turn}\n");
    }
    text + "0\nENDSEC\n0\nEOF\n"
}

#[test]
fn blocks_that_are_inserted_alike_are_copies() {
    let made = made(&blocks(&[(100.0, 0.0), (0.0, 0.0), (200.0, 90.0), (300.0, 0.0)]), SectionsBy::Found);
    assert_eq!(made.by, SectionsBy::Group);
    assert_eq!(ids(&made), [("NEST/1", 3, 1), ("NEST/2", 1, 1)]);
    // Touching inserts stay apart.
    assert_eq!(ids(&self::made(&blocks(&[(0.0, 0.0), (30.0, 0.0)]), SectionsBy::Group)), [("NEST", 2, 1)]);
    let array = blocks(&[(0.0, 0.0)])
        .replace("2\nNEST\n10\n0\n20\n0\n50", "2\nNEST\n70\n4\n44\n40\n10\n0\n20\n0\n50");
    assert_eq!(ids(&self::made(&array, SectionsBy::Group)), [("NEST", 4, 1)]);
}

/// Our own set: a wedge, an arrow, a slab.
const SET: &str = r#"{"name": "own", "strip_height": 100, "unknown": [1, {"a": 2}], "items": [
    {"id": 0, "demand": 5, "allowed_orientations": [0, 180], "shape": {"type": "simple_polygon",
        "data": [[0, 0], [40, 0], [0, 30], [0, 0]]}},
    {"id": "arrow", "demand": 4, "allowed_orientations": [0.0], "shape": {"data": [[5, 5], [25, 5], [45, 25], [25, 45], [5, 45]]}},
    {"demand": 3, "shape": {"data": [[0, 0], [0, 20], [120, 20], [120, 0]]}}]}"#;

#[test]
fn part_sets_become_blocks_of_the_strips_height() {
    let set = read_part_set(SET.as_bytes()).unwrap();
    assert_eq!((set.name.as_str(), set.strip_height_mm, set.pieces.len()), ("own", 100.0, 3));
    assert_eq!(set.pieces[2].id, "2");
    for seed in 0..20 {
        let rules = BlockRules { seed, gap_mm: 1.5, ..BlockRules::default() };
        let blocks = build_blocks(&set, &rules).unwrap();
        assert_eq!(blocks, build_blocks(&set, &rules).unwrap());
        let parts: usize = blocks.iter().map(|block| block.parts.len()).sum();
        assert_eq!(parts, 12, "every piece is used once");
        for block in &blocks {
            let bounds = block.bounds();
            assert!(bounds.max.y <= 100.0 + 1e-9 && bounds.min.x.abs() < 1e-9 && bounds.min.y.abs() < 1e-9);
            assert_apart(block, 1.5);
        }
    }
    let four =
        build_blocks(&set, &BlockRules { count: Some(40), columns: 1, ..BlockRules::default() }).unwrap();
    assert_eq!(four.len(), 40);
    assert!(four.iter().all(|block| !block.parts.is_empty()));
}

/// Boxes of parts keep the gap.
fn assert_apart(block: &Section, gap: f64) {
    let boxes: Vec<_> = block.parts.iter().map(|part| part.in_section().bounds()).collect();
    for (i, one) in boxes.iter().enumerate() {
        for other in &boxes[..i] {
            assert!(!one.grown(gap / 2.0 - 1e-9).meets(&other.grown(gap / 2.0 - 1e-9)), "{one:?} {other:?}");
        }
    }
}

#[test]
fn hostile_part_sets_are_refused_with_their_field() {
    let item = |demand: &str, data: &str| {
        format!(r#"{{"strip_height": 10, "items": [{{"demand": {demand}, "shape": {{"data": {data}}}}}]}}"#)
    };
    for (text, said) in [
        (String::new(), "no part set"),
        ("[]".to_owned(), "no part set"),
        ("{\"strip_height\": 1}".to_owned(), "items"),
        ("{\"strip_height\": -1, \"items\": []}".to_owned(), "strip_height"),
        ("{\"strip_height\": 1, \"items\": []}".to_owned(), "items: there are none"),
        ("{\"strip_height\": 1, \"items\": []} {}".to_owned(), "trailing"),
        (item("1", "[[0, 0], [1, 0]]"), "items[0].shape.data"),
        (item("1", "[[0, 0], [4, 4], [4, 0], [0, 3]]"), "cross"),
        (item("1", "[[0, 0], [1e9, 0], [0, 1]]"), "items[0].shape.data"),
        (item("1", "[[0, 0], [1, \"x\"]]"), "items[0].shape.data[1]"),
        (item("0", "[[0, 0], [1, 0], [0, 1]]"), "items[0].demand"),
        (item("-1", "[[0, 0], [1, 0], [0, 1]]"), "items[0].demand"),
        (item("4000000000", "[[0, 0], [1, 0], [0, 1]]"), "at most 100000"),
        (format!("{}1{}", "[".repeat(100_000), "]".repeat(100_000)), "no part set"),
    ] {
        let error = read_part_set(text.as_bytes()).unwrap_err();
        assert!(error.to_string().contains(said), "{said}: {error}");
    }
    assert_eq!(read_part_set(&vec![b' '; 20 << 20]).unwrap_err(), PartSetError::TooLong);
    let high = read_part_set(item("1", "[[0, 0], [30, 0], [30, 30], [0, 30]]").as_bytes()).unwrap();
    let error = build_blocks(&high, &BlockRules::default()).unwrap_err();
    assert!(error.to_string().contains("piece 0 is higher than the strip"), "{error}");
}

fn layout() -> (SectionLayout, Vec<PlacedSection>) {
    let set = read_part_set(SET.as_bytes()).unwrap();
    let sections = build_blocks(&set, &BlockRules::default()).unwrap();
    let layout = SectionLayout {
        sections,
        gap_mm: 2.0,
        strip_height_mm: Some(100.0),
        first: None,
        last: None,
        precedences: Vec::new(),
        forbidden_joins: Vec::new(),
        slide_rule: SlideRule::KeepOrder,
    };
    let mut x_mm = 0.0;
    let mut order = Vec::new();
    for (section, of) in layout.sections.iter().enumerate().rev() {
        order.push(PlacedSection { section, copy: 0, pose: Pose::AsIs, x_mm });
        // 7 mm nearer than by boxes; that they overlap is none of the picture's business.
        x_mm += of.bounds().size().x - 5.0;
    }
    (layout, order)
}

#[test]
fn pictures_of_layouts_tell_lengths_and_what_is_saved() {
    let (layout, order) = layout();
    let contacts = [(Point::new(10.0, 10.0), Point::new(12.0, 10.0))];
    let shown =
        ShownLayout { layout: &layout, order: &order, contacts: &contacts, lower_bound_mm: Some(1.0) };
    let svg = picture_of_layout(&shown, "own set <1>");
    assert_eq!(svg, picture_of_layout(&shown, "own set <1>"));
    let saved = 7.0 * (order.len() - 1) as f64;
    for words in [
        "own set &lt;1&gt;",
        &format!("{saved} mm saved"),
        "by bounding boxes",
        "no layout is shorter than 1 mm",
        "class=\"touch\"",
    ] {
        assert!(svg.contains(words), "{words}");
    }
    for width in [400, 800, 1600] {
        let png = png_of_svg(&svg, width).unwrap();
        assert_eq!(&png[1..4], b"PNG");
    }
    let proven = ShownLayout { lower_bound_mm: Some(1e9), ..shown };
    assert!(picture_of_layout(&proven, "").contains("proven"));
    let nothing = SectionLayout { sections: Vec::new(), ..layout };
    let empty = ShownLayout { layout: &nothing, order: &[], contacts: &[], lower_bound_mm: None };
    assert!(picture_of_layout(&empty, "").ends_with("</svg>\n"));
}

#[test]
fn layouts_are_written_as_dxf_and_read_back() {
    let (layout, order) = layout();
    let text = write_layout_dxf(&layout, &order).unwrap();
    let read = read_dxf(text.as_bytes(), &ReadOptions::default()).unwrap();
    let parts: usize = layout.sections.iter().map(|section| section.parts.len()).sum();
    let counts: Vec<(&str, usize)> =
        read.layers.iter().map(|layer| (layer.name.as_str(), layer.curves.len())).collect();
    assert_eq!(
        counts,
        [("TRAVERSE_STRIP", 1), ("TRAVERSE_PARTS", parts), ("TRAVERSE_SECTIONS", layout.sections.len())]
    );
    let first = &layout.sections[order[0].section];
    let drawn = read.layer("TRAVERSE_PARTS").unwrap().curves[0].edges().next().unwrap().start();
    let wanted = order[0].motion(&first.bounds()).point(first.parts[0].in_section().outer().vertices()[0]);
    assert!((drawn - wanted).norm() < 1e-9);
    let lost = PlacedSection { x_mm: f64::NAN, ..order[0] };
    assert!(write_layout_dxf(&layout, &[lost]).is_err());
}

#[test]
fn the_bundled_sections_are_ten() {
    let path = format!("{}/../../drawings/shoe-sections.svg", env!("CARGO_MANIFEST_DIR"));
    let made = made(&std::fs::read_to_string(path).unwrap(), SectionsBy::Found);
    assert!(made.is_complete(), "{}", made.report);
    assert_eq!(made.sections.len(), 10);
    for section in &made.sections {
        let size = section.bounds().size();
        assert!(size.y <= 300.0 + 1e-9 && size.y >= 270.0, "{} is {} high", section.id, size.y);
    }
}
