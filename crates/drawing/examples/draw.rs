//! Draws what a DXF file becomes: `cargo run -p traverse-drawing --example draw -- OUT DRAWING [CLEARANCE [X,Y ...]]`.
//!
//! OUT ends in `.svg`, or in `.png` behind an optional width: `1200:plan.png`. Points make a path of straight moves,
//! unchecked; a `/` before them says that there is none, `before` shows the straight move as it was. `mitred`
//! cuts corners square at twice the clearance. `inspect` instead of a clearance draws the drawing with its findings.

use traverse_drawing::{
    ReadOptions, SceneOptions, Shown, picture_of_drawing, picture_of_plan, png_of_svg, read_dxf_from,
    scene_from_drawing,
};
use traverse_geometry::{CornerStyle, Path, Point};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let out = arguments.next().ok_or("give a file to write")?;
    let file = arguments.next().ok_or("give a drawing")?;
    let clearance = arguments.next().unwrap_or_else(|| String::from("4"));
    let drawing = read_dxf_from(std::fs::File::open(&file)?, &ReadOptions::default())?;
    let title = std::path::Path::new(&file).file_name().unwrap_or_default().to_string_lossy();
    if clearance == "inspect" {
        let made = scene_from_drawing(&drawing, &SceneOptions::new(0.0));
        let findings = made.map(|made| made.report.findings).unwrap_or_default();
        return write(&out, &picture_of_drawing(&drawing, &findings, &title));
    }
    let mut made = scene_from_drawing(&drawing, &SceneOptions::new(clearance.parse()?))?;
    eprint!("{}", made.report);

    let mut word = String::new();
    let mut points = Vec::new();
    for argument in arguments {
        if let Some((x, y)) = argument.split_once(',') {
            points.push(Point::new(x.parse()?, y.parse()?));
        } else {
            word = argument;
        }
    }
    let separating: Vec<String> = made.scene.obstacles.iter().take(3).map(|each| each.id.clone()).collect();
    let mut path = Path::at(points.first().copied().unwrap_or_default());
    let mut straight = path.clone();
    points.iter().for_each(|&p| path.line_to(p));
    straight.line_to(path.end());
    let shown = match (&points[..], word.as_str()) {
        ([], _) => Shown::Scene,
        (&[start, target], "/") => Shown::NoPath { start, target, separating: &separating },
        (_, "before") => {
            Shown::Change { before: std::slice::from_ref(&straight), after: std::slice::from_ref(&path) }
        }
        _ => Shown::Path(&path),
    };
    if word == "mitred" {
        made.scene.corner_style = CornerStyle::Miter { limit: Some(2.0) };
    }
    write(&out, &picture_of_plan(&made.scene, shown, &title))
}

fn write(out: &str, svg: &str) -> Result<(), Box<dyn std::error::Error>> {
    let (width, name) = out.split_once(':').unwrap_or(("1200", out));
    if name.ends_with(".png") {
        std::fs::write(name, png_of_svg(svg, width.parse()?)?)?;
    } else {
        std::fs::write(name, svg)?;
    }
    Ok(())
}
