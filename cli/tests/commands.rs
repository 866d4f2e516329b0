//! The commands as users run them: the real binary, real files, a real server.

#![allow(clippy::unwrap_used, clippy::panic, clippy::expect_used, reason = "a test fails by panicking")]

use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};

fn traverse(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_traverse")).args(arguments).output().unwrap()
}

fn drawing(name: &str) -> String {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../drawings").join(name).display().to_string()
}

fn example() -> String {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/examples/plan-rapid-move.json").display().to_string()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

fn assert_ends(output: &Output, code: i32, said: &str) {
    let all = text(&output.stdout) + &text(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{all}");
    assert!(all.contains(said), "{said} is not in: {all}");
}

/// `traverse serve` on a free port; stopped when dropped.
struct Serving {
    child: Child,
    url: String,
}

impl Serving {
    fn start() -> Self {
        let mut child = Command::new(env!("CARGO_BIN_EXE_traverse"))
            .args(["serve", "--listen", "127.0.0.1:0", "--log-format", "json"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let mut line = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut line).unwrap();
        let url = line.trim().rsplit(' ').next().unwrap().to_owned();
        Self { child, url }
    }
}

impl Drop for Serving {
    fn drop(&mut self) {
        self.child.kill().unwrap();
        self.child.wait().unwrap();
    }
}

struct Planned {
    folder: tempfile::TempDir,
}

impl Planned {
    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn name(&self, name: &str) -> String {
        self.path(name).display().to_string()
    }
}

fn plan_across_the_mill(server: Option<&str>) -> Planned {
    let planned = Planned { folder: tempfile::tempdir().unwrap() };
    let (drawing, svg) = (drawing("vise-and-clamps.dxf"), planned.name("plan.svg"));
    let (json, request) = (planned.name("plan.json"), planned.name("request.json"));
    let mut arguments = vec![
        "rapid",
        &drawing,
        "--from",
        "30,150",
        "--to",
        "570,150",
        "--clearance",
        "5",
        "-o",
        &svg,
        "-o",
        &json,
    ];
    arguments.extend(["--request", &request]);
    arguments.extend(server.iter().flat_map(|url| ["--server", *url]));
    assert_ends(&traverse(&arguments), 0, "proven shortest");
    planned
}

#[test]
fn rapid_writes_picture_plan_and_request_that_check_accepts() {
    let planned = plan_across_the_mill(None);
    assert!(std::fs::read_to_string(planned.path("plan.svg")).unwrap().contains("</svg>"));
    let found = traverse(&["check", &planned.name("request.json"), &planned.name("plan.json")]);
    assert_ends(&found, 0, "sound");
}

#[test]
fn check_refuses_a_plan_that_was_tampered_with() {
    let planned = plan_across_the_mill(None);
    let mut plan: serde_json::Value =
        serde_json::from_slice(&std::fs::read(planned.path("plan.json")).unwrap()).unwrap();
    let y = &mut plan["plan"]["path"]["steps"][0]["end"]["yMm"];
    *y = (y.as_f64().unwrap() - 0.5).into();
    std::fs::write(planned.path("tampered.json"), plan.to_string()).unwrap();
    let found = traverse(&["check", &planned.name("request.json"), &planned.name("tampered.json")]);
    assert_ends(&found, 5, "violations");
}

#[test]
fn a_server_answers_what_the_process_answers() {
    let serving = Serving::start();
    let without_times = |planned: &Planned| {
        let mut plan: serde_json::Value =
            serde_json::from_slice(&std::fs::read(planned.path("plan.json")).unwrap()).unwrap();
        plan["stats"].as_object_mut().unwrap().retain(|key, _| !key.ends_with("Duration"));
        plan
    };
    let (here, there) = (plan_across_the_mill(None), plan_across_the_mill(Some(&serving.url)));
    assert_eq!(without_times(&here), without_times(&there));
    let limits = ["call", "GetLimits", "-", "--server", &serving.url];
    let mut child = Command::new(env!("CARGO_BIN_EXE_traverse"))
        .args(limits)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    std::io::Write::write_all(&mut child.stdin.take().unwrap(), b"{}").unwrap();
    assert_ends(&child.wait_with_output().unwrap(), 0, "vertexCount");
}

#[test]
fn call_answers_json_in_process_and_says_every_finding() {
    let answer = traverse(&["call", "PlanRapidMove", &example()]);
    assert_ends(&answer, 0, "lowerBound");
    let json: serde_json::Value = serde_json::from_slice(&answer.stdout).unwrap();
    assert_eq!(json["plan"]["cost"], json["plan"]["lowerBound"]);
    let folder = tempfile::tempdir().unwrap();
    let bad = folder.path().join("bad.json");
    std::fs::write(&bad, r#"{"start":{"xMm":"NaN"},"scene":{"clearanceMm":-1}}"#).unwrap();
    let refused = traverse(&["call", "PlanRapidMove", &bad.display().to_string()]);
    for finding in ["start.x_mm", "scene.clearance_mm", "target"] {
        assert_ends(&refused, 3, finding);
    }
}

#[test]
fn every_failure_has_its_code_and_says_what_to_do() {
    let mill = drawing("vise-and-clamps.dxf");
    let rapid = |more: &[&str]| {
        let base = ["rapid", mill.as_str(), "--from", "30,150"];
        traverse(&base.iter().chain(more).copied().collect::<Vec<_>>())
    };
    assert_ends(&rapid(&["--to", "nowhere", "--clearance", "5"]), 2, "write X,Y");
    assert_ends(&rapid(&["--to", "570,150", "--clearance", "-5"]), 3, "clearance_mm");
    assert_ends(&rapid(&["--to", "570,150", "--clearance", "5", "-o", "plan.pdf"]), 3, ".svg, .png, .json");
    assert_ends(&rapid(&["--to", "110,155", "--clearance", "5"]), 4, "PART/1");
    assert_ends(&rapid(&["--to", "100,200", "--clearance", "5"]), 3, "inside the barrier");
    let far = rapid(&["--to", "570,150", "--clearance", "5", "--server", "http://127.0.0.1:1"]);
    assert_ends(&far, 6, "traverse serve");
    let ftp = rapid(&["--to", "570,150", "--clearance", "5", "--server", "ftp://x"]);
    assert_ends(&ftp, 3, "no address");
    assert_ends(&traverse(&["call", "PlanLunch", &example()]), 3, "GetLimits");
    assert_ends(&traverse(&["call", "PlanRapidMove", "no-such-file.json"]), 3, "no-such-file.json");
    let readme = Path::new(env!("CARGO_MANIFEST_DIR")).join("../README.md").display().to_string();
    let not_dxf = traverse(&["rapid", &readme, "--from", "0,0", "--to", "1,1", "--clearance", "1"]);
    assert_ends(&not_dxf, 3, "export");
    assert_ends(&traverse(&["serve", "--listen", "127.0.0.1:0", "--workers", "0"]), 3, "workers is 0");
}

#[test]
fn the_demo_plans_checks_and_draws() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("pictures");
    let demo = traverse(&["demo", "--out", &out.display().to_string()]);
    assert_ends(&demo, 0, "mill-across");
    let table = text(&demo.stdout);
    let rows: Vec<&str> = table.lines().filter(|line| line.ends_with("µs")).collect();
    assert_eq!(rows.len(), 8, "{table}");
    assert!(rows.iter().all(|row| row.contains(" yes ") && !row.contains("REFUSED")), "{table}");
    assert_eq!(rows.iter().filter(|row| row.contains("no path")).count(), 1, "{table}");
    let sections: Vec<&str> = table.lines().filter(|line| line.ends_with(" ms")).collect();
    assert_eq!(sections.len(), 3, "{table}");
    assert!(sections.iter().all(|row| row.contains(" sound ")), "{table}");
    assert_eq!(std::fs::read_dir(out).unwrap().count(), rows.len() + sections.len());
}

/// `traverse order` on the bundled sections, with these arguments more.
fn order(more: &[&str]) -> Output {
    let sections = drawing("shoe-sections.svg");
    traverse(&[&["order", &sections, "--time", "5s"][..], more].concat())
}

#[test]
fn sections_are_ordered_written_and_checked_here_and_on_a_server() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).display().to_string();
    let (svg, png, dxf, json) = (at("layout.svg"), at("layout.png"), at("layout.dxf"), at("layout.json"));
    let request = at("request.json");
    let files = ["-o", &svg, "-o", &png, "-o", &dxf, "-o", &json, "--request", &request, "--width", "800"];
    let rules = ["--gap", "3", "--first", "heels", "--before", "welts,soles", "--forbid", "soles,uppers"];
    let output = order(&[&files[..], &rules].concat());
    assert_ends(&output, 0, "lower bound");
    let table = text(&output.stdout);
    assert!(table.contains("by boxes") && table.contains("    1  heels"), "{table}");
    assert!(std::fs::read_to_string(&svg).unwrap().contains("saved"));
    assert_eq!(&std::fs::read(&png).unwrap()[1..4], b"PNG");
    assert!(std::fs::read_to_string(&dxf).unwrap().contains("TRAVERSE_PARTS"));
    assert!(table.contains("checked          sound") && table.contains("recomputed, proves"), "{table}");
    let checked = traverse(&["check", &request, &json]);
    assert_ends(&checked, 0, "sound");
    assert!(text(&checked.stdout).contains("certified bound"), "{}", text(&checked.stdout));
    let mut bold: serde_json::Value = serde_json::from_slice(&std::fs::read(&json).unwrap()).unwrap();
    let claimed = &mut bold["report"]["certifiedLowerBound"];
    *claimed = (claimed.as_f64().unwrap() + 1.0).into();
    let claims = at("claims.json");
    std::fs::write(&claims, bold.to_string()).unwrap();
    assert_ends(&traverse(&["check", &request, &claims]), 5, "violations");

    let mut layout: serde_json::Value = serde_json::from_slice(&std::fs::read(&json).unwrap()).unwrap();
    let x = &mut layout["order"][4]["xMm"];
    *x = (x.as_f64().unwrap() - 20.0).into();
    let moved = at("moved.json");
    std::fs::write(&moved, layout.to_string()).unwrap();
    assert_ends(&traverse(&["check", &request, &moved]), 5, "violations");

    let serving = Serving::start();
    let there = order(&["--algorithm", "given-order", "--server", &serving.url]);
    let here = order(&["--algorithm", "given-order"]);
    assert_ends(&there, 0, "given order");
    let without_times = |output: &Output| {
        let said = text(&output.stdout);
        said.lines().filter(|line| !line.starts_with("method")).map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(without_times(&there), without_times(&here));
}

#[test]
fn what_is_wrong_with_sections_is_said() {
    assert_ends(&order(&["--first", "nobody"]), 3, "choose one of");
    assert_ends(&order(&["--gap", "-1"]), 3, "gap_mm");
    assert_ends(&order(&["--strip-height", "100"]), 3, "strip");
    assert_ends(&order(&["--before", "soles,heels", "--before", "heels,soles"]), 3, "precedences");
    assert_ends(&order(&["--before", "soles"]), 2, "write ID,ID");
    assert_ends(&order(&["-o", "layout.nc"]), 3, "a layout is written to");
    assert_ends(&order(&["--sections", "layer", "--ignore", "*"]), 3, "--sections");
    let folder = tempfile::tempdir().unwrap();
    let set = folder.path().join("set.json");
    let item = r#"{"demand": 4, "shape": {"data": [[0, 0], [30, 0], [10, 40]]}}"#;
    std::fs::write(&set, format!(r#"{{"strip_height": 90, "items": [{item}]}}"#)).unwrap();
    let set = set.display().to_string();
    assert_ends(&traverse(&["order", &set, "--poses", "as-is,mirror-x", "--columns", "1"]), 0, "block-2");
    std::fs::write(&set, r#"{"strip_height": 90, "items": []}"#).unwrap();
    assert_ends(&traverse(&["order", &set]), 3, "there are none");
    let apart: Vec<String> = ["soles,heels", "heels,soles"].map(str::to_owned).to_vec();
    let two = folder.path().join("two.svg");
    std::fs::write(
        &two,
        "<svg xmlns='http://www.w3.org/2000/svg' width='50mm' height='50mm' viewBox='0 0 50 50'>\
         <g id='soles'><rect width='10' height='10'/></g><g id='heels'><rect x='20' width='10' height='20'/></g></svg>",
    )
    .unwrap();
    let two = two.display().to_string();
    let none = ["order", &two, "--forbid", &apart[0], "--forbid", &apart[1]];
    assert_ends(&traverse(&none), 4, "leave no order");
}

#[test]
fn a_machine_profile_gives_clearance_and_g_code() {
    let planned = Planned { folder: tempfile::tempdir().unwrap() };
    let machines =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/examples/machines.toml").display().to_string();
    let (shaft, nc, dxf) = (drawing("turned-shaft.dxf"), planned.name("plan.nc"), planned.name("plan.dxf"));
    let base =
        ["rapid", &shaft, "--from", "100,38", "--to", "206,38", "-o", &nc, "-o", &dxf, "--time-limit", "30"];
    let ask = |more: &[&str]| traverse(&base.iter().chain(more).copied().collect::<Vec<_>>());
    assert_ends(&ask(&["--machines", &machines, "--machine", "lathe-2"]), 0, "130.986");
    let program = std::fs::read_to_string(planned.path("plan.nc")).unwrap();
    for word in ["O0002", "G18", "G2", "X132.", "Z206."] {
        assert!(program.contains(word), "{word} is not in: {program}");
    }
    assert!(std::fs::read_to_string(planned.path("plan.dxf")).unwrap().contains("TRAVERSE_PATH"));
    assert_ends(&ask(&["--machines", &machines, "--machine", "mill-9"]), 3, "lathe-2");
    assert_ends(&ask(&["--clearance", "4"]), 3, "--machine NAME");
    assert_ends(&ask(&["--clearance", "4", "--machine", "lathe-2"]), 2, "--machines");
}

/// A block between two points, a frame in which the tool may be changed above it.
const BLOCK_AND_FRAME: &str = r#"<svg xmlns="http://www.w3.org/2000/svg" width="200mm" height="100mm" viewBox="0 0 200 100">
<rect id="block" x="80" y="20" width="40" height="60"/><rect id="frame" x="90" y="2" width="20" height="10"/></svg>"#;

#[test]
fn a_tool_change_is_placed_checked_and_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let [drawing, svg, json, request] = ["block.svg", "change.svg", "change.json", "request.json"]
        .map(|name| folder.path().join(name).display().to_string());
    std::fs::write(&drawing, BLOCK_AND_FRAME).unwrap();
    let base = ["tool-change", &drawing, "--from", "20,50", "--to", "180,50", "--clearance", "5"];
    let ask = |more: &[&str]| traverse(&base.iter().chain(more).copied().collect::<Vec<_>>());
    let found = ask(&["--region", "id:frame", "-o", &svg, "-o", &json, "--request", &request]);
    // y is up: the frame's lower border is at 88.
    assert_ends(&found, 0, "place        100.000000, 88.000000");
    assert_ends(&found, 0, "proven cheapest");
    assert_ends(&found, 0, "checked      sound");
    let picture = std::fs::read_to_string(&svg).unwrap();
    assert!(picture.contains("class=\"region\"") && picture.contains("tool change at 100, 88"));
    let called = traverse(&["call", "PlaceToolChange", &request]);
    let [there, here]: [serde_json::Value; 2] =
        [called.stdout, std::fs::read(&json).unwrap()].map(|text| serde_json::from_slice(&text).unwrap());
    assert_eq!(there["plan"], here["plan"]);
    assert_ends(&ask(&["--at", "20,90", "--at", "150,90"]), 0, "place        150.000000, 90.000000");
    assert_ends(&ask(&["--at", "100,50"]), 4, "0/1 in the way");
    assert_ends(&ask(&["--region", "id:frame", "--alternatives", "2"]), 3, "traverse rapid");
    assert_ends(&ask(&["--region", "id:frame", "-o", "change.dxf"]), 3, ".svg, .png or .json");
    assert_ends(&ask(&[]), 2, "--region");
}

#[test]
fn alternatives_are_told_and_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let [drawing, svg] = ["block.svg", "ways.svg"].map(|name| folder.path().join(name).display().to_string());
    std::fs::write(&drawing, BLOCK_AND_FRAME).unwrap();
    let more = ["--alternatives", "3", "-o", &svg];
    let base = ["rapid", &drawing, "--from", "20,52", "--to", "180,52", "--clearance", "2"];
    let found = traverse(&base.iter().chain(&more).copied().collect::<Vec<_>>());
    assert_ends(&found, 0, "proven shortest");
    assert_eq!(text(&found.stdout).matches("other way").count(), 3, "{}", text(&found.stdout));
    assert!(std::fs::read_to_string(&svg).unwrap().contains("other ways"));
}

#[test]
fn seconds_dog_legs_and_chords_are_planned_written_and_checked() {
    let planned = Planned { folder: tempfile::tempdir().unwrap() };
    let machines =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/examples/machines.toml").display().to_string();
    let mill = drawing("vise-and-clamps.dxf");
    let (nc, plan, request) =
        (planned.name("plan.nc"), planned.name("plan.json"), planned.name("request.json"));
    let base = ["rapid", &mill, "--from", "20,20", "--to", "380,230", "-o", &plan, "--request", &request];
    let roles =
        ["--obstacles", "VISE", "--obstacles", "CLAMPS", "--obstacles", "PINS", "--obstacles", "STOP"];
    let ask = |more: &[&str]| traverse(&[&base[..], &roles, more].concat());
    let check = |said: &str| assert_ends(&traverse(&["check", &request, &plan]), 0, said);

    let by_axes = ["--clearance", "5", "--cost", "axis-speeds", "--axis-speeds", "24000,12000"];
    assert_ends(&ask(&by_axes), 0, "s, proven best");
    check("sound");
    let limits =
        ["--clearance", "5", "--cost", "kinematics", "--rapid-speed", "20000", "--acceleration", "1500"];
    assert_ends(&ask(&limits), 0, "lower bound  ");
    check(" s (the plan says");
    let profile = ["--machines", &machines, "--machine", "mill-3", "-o", &nc];
    assert_ends(&ask(&profile), 0, "of which 0 are arcs");
    check("sound");
    let program = std::fs::read_to_string(planned.path("plan.nc")).unwrap();
    assert!(!program.contains("G2 ") && !program.contains("G3 ") && program.contains("G0"), "{program}");

    assert_ends(&ask(&["--clearance", "5", "--cost", "kinematics"]), 3, "--acceleration");
    assert_ends(&ask(&["--clearance", "5", "--g0", "dog-leg"]), 3, "--axis-speeds X,Y");
    assert_ends(
        &ask(&[&by_axes[..2], &["--g0", "dog-leg", "--cost", "length"]].concat()),
        3,
        "leave --cost out",
    );
    assert_ends(&ask(&[&by_axes[..5], &["0,1"]].concat()), 3, "rules.cost.axis_speeds.x_mm_per_s");

    let text = rewrite("stop-and-plate.nc", &["--g0", "dog-leg", "--axis-speeds", "12000,6000"]);
    assert_ends(&text, 0, "before s   after s");
    assert_ends(&rewrite("stop-and-plate.nc", &["--arcs", "chords"]), 3, "--arcs is for plans");
}

/// `traverse rapid --program` on the bundled mill, with these arguments more.
fn rewrite(program: &str, more: &[&str]) -> Output {
    let (drawing, program) = (drawing("vise-and-clamps.dxf"), example_program(program));
    let mut arguments = vec!["rapid", &drawing, "--clearance", "5", "--program", &program];
    for layer in ["VISE", "CLAMPS", "PINS", "STOP"] {
        arguments.extend(["--obstacles", layer]);
    }
    arguments.extend(more);
    traverse(&arguments)
}

fn example_program(name: &str) -> String {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/examples/programs").join(name).display().to_string()
}

#[test]
fn a_program_is_rewritten_with_a_table_and_a_picture() {
    let folder = tempfile::tempdir().unwrap();
    let [nc, svg] = ["out.ngc", "out.svg"].map(|name| folder.path().join(name).display().to_string());
    let more = ["--safe-z", "60", "--arc-feed", "6000", "-o", &nc, "-o", &svg];
    let output = rewrite("plate-and-vise.ngc", &more);
    assert_ends(&output, 0, "4 of 9 rapid moves replaced; 4 ran too near");
    assert_ends(&output, 0, "too near to PINS/3, CLAMPS/1");
    assert_ends(
        &output,
        0,
        "line 9: not looked at: where it begins is not known since line 7: a tool change",
    );
    assert!(std::fs::read_to_string(&nc).unwrap().contains("N300 X100 Y150 (POCKET)\n"));
    assert!(std::fs::read_to_string(&svg).unwrap().contains("shorter"));
}

#[test]
fn what_still_hits_ends_with_5_and_a_profile_speaks_for_tools_offsets_and_times() {
    let folder = tempfile::tempdir().unwrap();
    let machines = folder.path().join("machines.toml");
    let text = "[machine.m]\nclearance_mm = 5\n[machine.m.speeds]\narc_feed_mm_per_min = 6000\n\
                rapid_mm_per_min = 12000\n[machine.m.tools]\n1 = { diameter_mm = 6.0, margin_mm = 1.0 }\n\
                [machine.m.offsets]\nG54 = [0, 0]\nG55 = [340, 92]\n[machine.m.gcode]\ndialect = \"fanuc\"\n";
    std::fs::write(&machines, text).unwrap();
    let profile = machines.display().to_string();
    let output = rewrite("stop-and-plate.nc", &["--machines", &profile, "--machine", "m"]);
    assert_ends(&output, 0, "before s   after s");
    assert_ends(
        &rewrite("table-engraving.gcode", &[]),
        5,
        "STILL TOO NEAR to VISE/1: protected by a comment",
    );
}

#[test]
fn a_program_that_cannot_be_read_ends_with_3() {
    let folder = tempfile::tempdir().unwrap();
    let drawing = drawing("vise-and-clamps.dxf");
    for (text, said) in [("Dear Sir,\n", "no G-code"), ("G0\0", "line 1 holds a NUL byte")] {
        let program = folder.path().join("bad.nc");
        std::fs::write(&program, text).unwrap();
        let program = program.display().to_string();
        assert_ends(&traverse(&["rapid", &drawing, "--clearance", "5", "--program", &program]), 3, said);
    }
    let dxf = folder.path().join("out.dxf").display().to_string();
    assert_ends(&rewrite("plate-and-vise.ngc", &["-o", &dxf]), 3, "a program is written to .nc");
    assert_ends(&rewrite("plate-and-vise.ngc", &["--to", "1,1"]), 2, "cannot be used with");
}

/// A wall right across, with a gap, in a work area.
fn wall(folder: &Path) -> String {
    let svg = "<svg xmlns='http://www.w3.org/2000/svg' width='200mm' height='100mm' viewBox='0 0 200 100'>\
        <g id='WORK_AREA'><rect x='0' y='0' width='200' height='100'/></g>\
        <g id='CLAMPS'><rect x='90' y='0' width='20' height='48'/><rect x='90' y='53' width='20' height='47'/></g></svg>";
    let file = folder.join("wall.svg");
    std::fs::write(&file, svg).unwrap();
    file.display().to_string()
}

#[test]
fn heights_clearances_and_ways_out_are_planned_drawn_and_checked() {
    let folder = tempfile::tempdir().unwrap();
    let wall = wall(folder.path());
    let at = |name: &str| folder.path().join(name).display().to_string();
    let (request, plan, svg) = (at("request.json"), at("plan.json"), at("plan.svg"));
    let ends = ["rapid", &wall, "--from", "20,20", "--to", "180,20"];
    let with = |more: &[&str]| traverse(&[&ends[..], more].concat());
    let files = ["-o", &plan, "-o", &svg, "--request", &request];
    let check = || assert_ends(&traverse(&["check", &request, &plan]), 0, "sound");

    assert_ends(&with(&["--clearance", "4"]), 4, "at a clearance of 2.5");
    let narrow = with(&[&["--clearance", "4,2,1"][..], &files].concat());
    assert_ends(&narrow, 0, "clearance    2 mm");
    check();
    let heights =
        ["--clearance", "4", "--start-z", "1", "--highest-z", "30", "--clearance-z", "2", "--top", "25"];
    let over = with(&[&heights[..], &files].concat());
    assert_ends(&over, 0, "travels at   z = 27 mm");
    assert_ends(&over, 0, "length       212.000000 mm");
    check();
    let picture = std::fs::read_to_string(&svg).unwrap();
    assert!(picture.contains("at z = 27 mm") && picture.contains("obstacle passed"), "{picture}");
    assert_ends(&with(&["--clearance", "4", "--start-z", "1"]), 2, "--highest-z");

    let leave = ["--from", "88,20", "--to", "20,20", "--clearance", "4", "--leave", "nearest"];
    let left = traverse(&[&["rapid", &wall][..], &leave, &files].concat());
    assert_ends(&left, 0, "length       68.000000 mm");
    check();
    let leave = ["--from", "88,20", "--to", "20,20", "--clearance", "4", "--leave", "1,0"];
    assert_ends(&traverse(&[&["rapid", &wall][..], &leave].concat()), 3, "has no way out");
}

fn matrix(name: &str) -> String {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates/tours/tests/data").join(name).display().to_string()
}

#[test]
fn solve_prints_one_line_with_cost_bound_and_proof() {
    let output = traverse(&["solve", &matrix("br17.atsp"), "--time-limit", "60s", "--seed", "3", "--tour"]);
    assert_ends(&output, 0, "");
    let said = text(&output.stdout);
    assert_eq!(said.lines().count(), 1, "{said}");
    let answer: serde_json::Value = serde_json::from_str(&said).unwrap();
    assert_eq!((answer["cost"].as_i64(), answer["lower_bound"].as_i64()), (Some(39), Some(39)));
    assert_eq!((answer["proven"].as_bool(), answer["ending"].as_str()), (Some(true), Some("proven_optimal")));
    assert_eq!(answer["tour"].as_array().map(Vec::len), Some(17));
}

#[test]
fn solve_says_which_line_is_wrong_and_proves_that_there_is_no_tour() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, content: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, content).unwrap();
        path.display().to_string()
    };
    let wrong = write("wrong.atsp", "DIMENSION: 0\n");
    assert_ends(&traverse(&["solve", &wrong]), 3, "line 1: DIMENSION is \"0\"");
    let head = "TYPE: SOP\nDIMENSION: 4\nEDGE_WEIGHT_TYPE: EXPLICIT\nEDGE_WEIGHT_FORMAT: FULL_MATRIX\n";
    let circle =
        write("circle.sop", &format!("{head}EDGE_WEIGHT_SECTION\n0 1 1 1\n1 0 -1 1\n1 -1 0 1\n1 1 1 0\n"));
    assert_ends(&traverse(&["solve", &circle]), 3, "before itself");
    let ordered = matrix("br17.12.sop");
    assert_ends(&traverse(&["solve", &ordered, "--method", "ant-colony"]), 3, "use the ladder");
}

const STEPS: &str = r#"{"step_id":"plate","scene":{"obstacles":[{"id":"plate","shape":{"outer":{"xy_mm":[0,0,60,0,60,40,0,40]}}}],"clearance_mm":3}}
{"step_id":"1","query":{"start":{"x_mm":-10,"y_mm":5},"target":{"x_mm":80,"y_mm":5}}}

{"step_id":"oops","query":{"start":{"x_mm":5,"y_mm":5},"target":{"x_mm":80,"y_mm":5}}}
{"step_id":"off","edit":{"remove_obstacle_ids":["plate"]}}
{"step_id":"2","query":{"start":{"x_mm":-10,"y_mm":5},"target":{"x_mm":80,"y_mm":5}}}
"#;

#[test]
fn a_session_is_lines_in_and_lines_out() {
    let serving = Serving::start();
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("steps.ndjson");
    std::fs::write(&file, STEPS).unwrap();
    let file = file.display().to_string();
    for server in [&[][..], &["--server", &serving.url]] {
        let output = traverse(&[&["call", "PlanRapidMoves", &file][..], server].concat());
        assert_ends(&output, 0, "END_INSIDE_BARRIER");
        let lines: Vec<serde_json::Value> =
            text(&output.stdout).lines().map(|line| serde_json::from_str(line).unwrap()).collect();
        let ids: Vec<&str> = lines.iter().map(|line| line["stepId"].as_str().unwrap()).collect();
        assert_eq!(ids, ["plate", "1", "oops", "off", "2"]);
        assert_eq!(lines[4]["plan"]["cost"], 90.0);
    }
}

#[test]
fn a_session_answers_while_steps_are_typed() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_traverse"))
        .args(["call", "PlanRapidMoves", "-"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut typed = child.stdin.take().unwrap();
    let mut told = BufReader::new(child.stdout.take().unwrap());
    for step in STEPS.lines().filter(|line| !line.is_empty()) {
        writeln!(typed, "{step}").unwrap();
        let mut answer = String::new();
        told.read_line(&mut answer).unwrap();
        assert!(answer.contains("stepId"), "{answer}");
    }
    drop(typed);
    assert_eq!(child.wait().unwrap().code(), Some(0));
}

#[test]
fn distances_are_answered_as_json() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("request.json");
    std::fs::write(&file, r#"{"from_xy_mm":[0,0,3,4]}"#).unwrap();
    let output = traverse(&["call", "PlanDistances", &file.display().to_string()]);
    assert_ends(&output, 0, r#"{"costs":[0.0,5.0,5.0,0.0],"costUnit":"COST_UNIT_MM"}"#);
}

#[test]
fn an_empty_drawing_is_refused_and_no_file_is_written_before_a_refusal() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).display().to_string();
    let write = |name: &str, entities: &str| {
        std::fs::write(at(name), format!("0\nSECTION\n2\nENTITIES\n{entities}0\nENDSEC\n0\nEOF\n")).unwrap();
        at(name)
    };
    let ends = ["--from", "0,0", "--to", "50,0", "--clearance", "1"];
    let rapid = |file: &str, more: &[&str]| traverse(&[&["rapid", file][..], &ends, more].concat());
    let empty = write("empty.dxf", "");
    assert_ends(&rapid(&empty, &[]), 3, "neither an obstacle nor a work area");
    assert_ends(&rapid(&empty, &["--ignore-unused"]), 0, "goes round   nothing");
    let negative = write("negative.dxf", "0\nCIRCLE\n8\nA\n10\n20\n20\n0\n40\n-5\n");
    assert_ends(&rapid(&negative, &[]), 3, "numbers contradict one another");
    let band = "0\nLWPOLYLINE\n8\nA\n70\n1\n43\n10\n10\n20\n20\n0\n10\n30\n20\n0\n10\n30\n20\n9\n";
    assert_ends(&rapid(&write("band.dxf", band), &[]), 3, "its width is not read");

    let svg = at("plan.svg");
    let output = rapid(&drawing("vise-and-clamps.dxf"), &["-o", &svg, "-o", &at("plan.nc")]);
    assert_ends(&output, 3, "G-code differs by machine");
    assert!(!Path::new(&svg).exists());
}

#[test]
fn a_program_passes_over_what_is_low() {
    let folder = tempfile::tempdir().unwrap();
    let [nc, svg] = ["out.ngc", "out.svg"].map(|name| folder.path().join(name).display().to_string());
    let more = ["--top", "20", "--clearance-z", "2", "-o", &nc, "-o", &svg];
    assert_ends(&rewrite("high-retracts.ngc", &more), 0, "4 of 4 rapid moves replaced");
    let text = std::fs::read_to_string(&nc).unwrap();
    let picture = std::fs::read_to_string(&svg).unwrap();
    assert!(picture.contains("370.82 mm, before 965.172 mm: 61.6 % shorter"), "rises count");
    assert!(text.contains("N80 G0 Z5\nN90 X385 Y200\n") && !text.contains("N240 G0 Z5\n"), "{text}");
    assert_ends(&rewrite("plate-and-vise.ngc", &["--clearance-z", "2"]), 3, "no top is known");
    assert_ends(
        &rewrite("plate-and-vise.ngc", &["--top", "20", "--alternatives", "2"]),
        2,
        "cannot be used with",
    );
    assert_ends(&rewrite("plate-and-vise.ngc", &["--top", "20", "--start-z", "2"]), 2, "cannot be used with");
    assert_ends(&rewrite("plate-and-vise.ngc", &["--time-limit", "0"]), 7, "time was over");
}
