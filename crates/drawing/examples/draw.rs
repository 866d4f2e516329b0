//! Draws what a DXF file becomes: `cargo run -p traverse-drawing --example draw -- DRAWING [CLEARANCE [X,Y ...]]`.
//!
//! Points make a path of straight moves, unchecked; `/` before them says that there is none.

use traverse_drawing::{
    ReadOptions, SceneOptions, Shown, picture_of_plan, read_dxf_from, scene_from_drawing,
};
use traverse_geometry::{Path, Point};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let file = arguments.next().ok_or("give a drawing")?;
    let clearance_mm = arguments.next().map_or(Ok(4.0), |text| text.parse())?;
    let drawing = read_dxf_from(std::fs::File::open(&file)?, &ReadOptions::default())?;
    let made = scene_from_drawing(&drawing, &SceneOptions::new(clearance_mm))?;
    eprint!("{}", made.report);

    let mut blocked = false;
    let mut points = Vec::new();
    for argument in arguments {
        if let Some((x, y)) = argument.split_once(',') {
            points.push(Point::new(x.parse()?, y.parse()?));
        } else {
            blocked = true;
        }
    }
    let separating: Vec<String> = made.scene.obstacles.iter().take(3).map(|each| each.id.clone()).collect();
    let mut path = Path::at(points.first().copied().unwrap_or_default());
    points.iter().for_each(|&p| path.line_to(p));
    let shown = match points[..] {
        [] => Shown::Scene,
        [start, target] if blocked => Shown::NoPath { start, target, separating: &separating },
        _ => Shown::Path(&path),
    };
    let title = std::path::Path::new(&file).file_name().unwrap_or_default().to_string_lossy();
    print!("{}", picture_of_plan(&made.scene, shown, &title));
    Ok(())
}
