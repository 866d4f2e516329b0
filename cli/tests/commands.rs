//! The commands as users run them: the real binary, real files, a real server.

#![allow(clippy::unwrap_used, clippy::panic, clippy::expect_used, reason = "a test fails by panicking")]

use std::io::{BufRead, BufReader};
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
    assert_eq!(std::fs::read_dir(out).unwrap().count(), rows.len());
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
