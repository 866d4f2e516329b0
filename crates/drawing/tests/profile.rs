//! Profiles are read whole or refused with file, line, key and value.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

use traverse_drawing::{
    ArcMotion, GcodeDialect, GcodePlane, GcodeUnit, JUNCTION_DEVIATION_MM, ObstacleRole, PROFILE_BYTE_LIMIT,
    ProfileError, Profiles, SceneOptions, StraightMotion, XWord,
};
use traverse_geometry::{CornerStyle, RapidMotion};

const BOTH: &str = r#"
[machine.plasma-2]
clearance_mm = 3
border_clearance_mm = 0.0
corner_style = "miter"
miter_limit = 4.0

[machine.plasma-2.roles]
work_area = ["TABLE*"]
obstacles = ["CLAMPS", "PARTS_*"]

[machine.plasma-2.speeds]
arc_feed_mm_per_min = 6000

[machine.plasma-2.gcode]
dialect = "grbl"
decimals = 4

[machine."Lathe 1"]
[machine."Lathe 1".speeds]
straight_feed_mm_per_min = 9000.5
[machine."Lathe 1".gcode]
dialect = "fanuc"
unit = "inch"
plane = "G18"
x_word = "diameter"
straight = "G1"
arcs = "chords"
program_number = 17
header = ["(LATHE 1)"]
safe_start = []
"#;

fn read(text: &str) -> Result<Profiles, ProfileError> {
    Profiles::read_from(text.as_bytes(), "shop.toml")
}

fn refused(text: &str) -> String {
    read(text).unwrap_err().to_string()
}

#[test]
fn machines_are_chosen_by_name() {
    let profiles = read(BOTH).unwrap();
    let plasma = profiles.machine("plasma-2").unwrap();
    let mut options = SceneOptions::new(1.0);
    plasma.apply_to(&mut options);
    assert_eq!((options.clearance_mm, options.work_area_clearance_mm), (3.0, Some(0.0)));
    assert_eq!(options.corner_style, CornerStyle::Miter { limit: Some(4.0) });
    assert_eq!(options.roles.obstacles, ["CLAMPS", "PARTS_*"].map(ObstacleRole::new));
    assert_eq!(options.roles.work_area, ["TABLE*".into()]);
    let gcode = plasma.gcode.as_ref().unwrap();
    assert_eq!((gcode.dialect, gcode.decimals), (GcodeDialect::Grbl, Some(4)));
    assert_eq!(gcode.arcs, ArcMotion::Fed { feed_mm_per_min: 6000.0 });

    let lathe = profiles.machine("Lathe 1").unwrap();
    let mut untouched = SceneOptions::new(1.0);
    lathe.apply_to(&mut untouched);
    assert_eq!(untouched, SceneOptions::new(1.0));
    let gcode = lathe.gcode.as_ref().unwrap();
    assert_eq!((gcode.unit, gcode.plane), (GcodeUnit::Inches, GcodePlane::Zx { x: XWord::Diameter }));
    assert_eq!(gcode.straight, StraightMotion::Fed { feed_mm_per_min: 9000.5 });
    assert_eq!(gcode.arcs, ArcMotion::Chords { tolerance_mm: 0.01 });
    assert_eq!((gcode.program_number, gcode.safe_start.as_deref()), (17, Some(&[][..])));

    let unknown = profiles.machine("plasma").unwrap_err().to_string();
    assert_eq!(unknown, "shop.toml has no machine `plasma`; it has: Lathe 1, plasma-2");
}

#[test]
fn the_documented_profile_is_read() {
    let source = include_str!("../src/profile.rs");
    let documented: Vec<&str> = source
        .lines()
        .skip_while(|line| *line != "/// ```toml")
        .skip(1)
        .take_while(|line| *line != "/// ```")
        .map(|line| line.trim_start_matches("///"))
        .collect();
    let profiles = read(&documented.join("\n")).unwrap();
    assert!(profiles.machine("plasma-2").unwrap().gcode.is_some());
}

#[test]
fn unknown_keys_are_refused_with_line_and_known_names() {
    for (text, expected) in [
        (
            "[machine.a]\nclearance = 2\n",
            "shop.toml:2: machine.a.clearance: unknown field `clearance`, expected one of `clearance_mm`, \
             `border_clearance_mm`, `corner_style`, `miter_limit`, `g0`, `roles`, `speeds`, `gcode`, `tools`, `offsets`; correct this \
             line",
        ),
        (
            "[machine.a.roles]\nobstacles = [\"*\"]\npart = [\"P\"]\n",
            "shop.toml:3: machine.a.roles.part: unknown field `part`, expected one of \
             `work_area`, `parts`, `sections`, `obstacles`; \
             correct this line",
        ),
        (
            "[machine.a.gcode]\nunit = \"cm\"\n",
            "shop.toml:2: machine.a.gcode.unit: unknown variant `cm`, expected `mm` or `inch`; correct this line",
        ),
    ] {
        assert_eq!(refused(text), expected);
    }
    assert!(refused("machine.a.clearance_mm = \"2\"").starts_with("shop.toml:1: machine.a.clearance_mm: "));
    assert!(refused("\n[machine.a\n").starts_with("shop.toml:2: "));
    assert!(refused("").contains("missing field `machine`"));
    assert!(refused("[machine.a]\n[machine.a]\n").contains("duplicate"));
}

#[test]
fn values_out_of_range_are_reported_all_at_once() {
    let findings = refused(
        "[machine.a]\nclearance_mm = -1\nborder_clearance_mm = nan\nmiter_limit = 0.5\n\
         [machine.a.roles]\nobstacles = []\nwork_area = [\"\"]\n\
         [machine.a.speeds]\narc_feed_mm_per_min = 0\n\
         [machine.a.gcode]\nx_word = \"radius\"\ndecimals = 7\nstraight = \"G1\"\nchord_tolerance_mm = 1\n\
         program_number = 2\nheader = [\"(\"]\n",
    );
    let lines: Vec<&str> = findings.lines().collect();
    for (line, expected) in [
        "2: machine.a.clearance_mm: -1 ",
        "3: machine.a.border_clearance_mm: NaN ",
        "4: machine.a.miter_limit: has no effect",
        "4: machine.a.miter_limit: 0.5 is no ratio",
        "6: machine.a.roles.obstacles: the list is empty",
        "7: machine.a.roles.work_area: a selector is empty",
        "9: machine.a.speeds.arc_feed_mm_per_min: is 0: use 1 to",
        "10: machine.a.speeds.straight_feed_mm_per_min: is missing",
        "11: machine.a.gcode.x_word: has no effect in G17",
        "12: machine.a.gcode.decimals: is 7: linuxcnc takes 1 to 6",
        "14: machine.a.gcode.chord_tolerance_mm: has no effect",
        "15: machine.a.gcode.program_number: only Fanuc",
        "16: machine.a.gcode.header: is `(`: the comment is not closed",
    ]
    .iter()
    .enumerate()
    {
        assert!(lines[line].starts_with(&format!("shop.toml:{expected}")), "{findings}");
    }
    assert_eq!(lines.len(), 13, "{findings}");
}

#[test]
fn hostile_files_are_bounded() {
    let long = "#".repeat(PROFILE_BYTE_LIMIT as usize + 1);
    assert!(matches!(read(&long), Err(ProfileError::TooLong { .. })));
    let endless = std::io::repeat(b'[');
    assert!(matches!(Profiles::read_from(endless, "x"), Err(ProfileError::TooLong { .. })));
    let deep = format!("machine = {}", "[".repeat(200_000));
    assert!(matches!(read(&deep), Err(ProfileError::Findings { .. })));
    let dotted = format!("machine{} = 1", ".a".repeat(100_000));
    assert!(matches!(read(&dotted), Err(ProfileError::Findings { .. })));
    let not_text = Profiles::read_from(&b"[machine.a]\n# \xff\n"[..], "x").unwrap_err();
    assert!(matches!(not_text, ProfileError::NotUtf8 { line: 2, .. }));
    assert!(read("\u{feff}[machine.a]\r\nclearance_mm = 1\r\n").is_ok());
    for length in 0..BOTH.len() {
        let _ = read(&BOTH[..length]);
    }
}

#[test]
fn obstacles_may_carry_a_top_and_a_clearance() {
    let text = r#"
[machine.m.roles]
parts = ["group:part-*"]
sections = ["layer:SECTION*"]
obstacles = ["CLAMPS", { select = "color:red", top_mm = 25.0, clearance_mm = 4.0 }]
"#;
    let mut options = SceneOptions::new(1.0);
    read(text).unwrap().machine("m").unwrap().apply_to(&mut options);
    let red = ObstacleRole { top_mm: Some(25.0), clearance_mm: Some(4.0), ..ObstacleRole::new("color:red") };
    assert_eq!(options.roles.obstacles, [ObstacleRole::new("CLAMPS"), red]);
    assert_eq!(options.roles.parts, ["group:part-*".into()]);
    assert_eq!(options.roles.sections, ["layer:SECTION*".into()]);
    for (role, what) in [
        (r#"{ select = "A", clearance_mm = -1.0 }"#, "-1 is no clearance"),
        (r#"{ select = "A", top_mm = nan }"#, "top_mm = NaN"),
        (r#"{ select = "" }"#, "fits nothing"),
        (r#"{ select = "A", height = 3 }"#, "select = "),
        ("3", "select = "),
    ] {
        let message = refused(&format!("[machine.m.roles]\nobstacles = [{role}]\n"));
        assert!(message.contains(what) && message.starts_with("shop.toml:2: "), "{message}");
    }
}

#[test]
fn tools_offsets_and_the_speed_of_rapids_are_read() {
    let text = "[machine.m.tools]\n3 = { diameter_mm = 12, margin_mm = 1 }\n7 = { clearance_mm = 4 }\n\
                [machine.m.offsets]\nG55 = [300, -5.5]\n\"G59.1\" = [0, 0]\n\
                [machine.m.speeds]\nrapid_mm_per_min = 20000\n";
    let profiles = read(text).unwrap();
    let machine = profiles.machine("m").unwrap();
    assert_eq!(
        machine.tool_clearances_mm.iter().map(|(n, c)| (*n, *c)).collect::<Vec<_>>(),
        [(3, 7.0), (7, 4.0)]
    );
    assert_eq!(machine.offsets.keys().copied().collect::<Vec<_>>(), [1, 6]);
    assert_eq!(machine.speeds.rapid_mm_per_min, Some(20000.0));
    assert_eq!((machine.g0, machine.speeds.axis_speeds(), machine.speeds.kinematics()), (None, None, None));
    let refused = refused(
        "[machine.m.tools]\n3 = { diameter_mm = 12 }\nx = { clearance_mm = 1 }\n4 = { clearance_mm = -1 }\n\
         [machine.m.offsets]\nG60 = [0, 0]\nG54 = [1e9, 0]\n[machine.m.speeds]\nrapid_mm_per_min = 0\n",
    );
    for line in [2, 3, 4, 6, 7, 9] {
        assert!(refused.contains(&format!("shop.toml:{line}: machine.m.")), "{line}: {refused}");
    }
}

#[test]
fn speeds_of_axes_and_acceleration_are_read() {
    let text = "[machine.m]\ng0 = \"dog-leg\"\n[machine.m.speeds]\nrapid_x_mm_per_min = 12000\nrapid_y_mm_per_min = 6000\n\
                rapid_mm_per_min = 9000\nacceleration_mm_per_s2 = 1500\narc_feed_mm_per_min = 3000\n";
    let profiles = read(text).unwrap();
    let machine = profiles.machine("m").unwrap();
    assert_eq!(machine.g0, Some(RapidMotion::DogLeg));
    let axes = machine.speeds.axis_speeds().unwrap();
    assert_eq!((axes.x_mm_per_s, axes.y_mm_per_s, axes.z_mm_per_s), (200.0, 100.0, 0.0));
    let limits = machine.speeds.kinematics().unwrap();
    assert_eq!((limits.speed_mm_per_s, limits.z_mm_per_s, limits.feed_mm_per_s), (150.0, 150.0, 50.0));
    assert_eq!(
        (limits.acceleration_mm_per_s2, limits.junction_deviation_mm),
        (1500.0, JUNCTION_DEVIATION_MM)
    );
    let refused = refused(
        "[machine.m]\ng0 = \"dog-leg\"\n[machine.m.speeds]\nrapid_x_mm_per_min = 0\nrapid_z_mm_per_min = nan\n\
         acceleration_mm_per_s2 = -1\njunction_deviation_mm = 11\narc_feed_mm_per_min = inf\n",
    );
    let lines: Vec<&str> = refused.lines().map(|line| line.split(':').nth(1).unwrap()).collect();
    assert_eq!(lines, ["2", "4", "5", "6", "7", "8"], "{refused}");
}
