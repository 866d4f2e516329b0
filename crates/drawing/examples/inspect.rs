fn main() {
    for path in std::env::args().skip(1) {
        let bytes = std::fs::read(&path).unwrap_or_default();
        let t = std::time::Instant::now();
        match traverse_drawing::read_dxf(&bytes, &Default::default()) {
            Ok(d) => {
                println!("{path}: {:?} unit {} assumed {} curves {}", t.elapsed(), d.unit, d.unit_assumed, d.curve_count());
                match traverse_drawing::scene_from_drawing(&d, &traverse_drawing::SceneOptions::new(1.0)) {
                    Ok(s) => {
                        println!("{:?}\n{}{} obstacles", t.elapsed(), s.report, s.scene.obstacles.len());
                        let svg = traverse_drawing::picture_of_plan(&s.scene, traverse_drawing::Shown::Scene, &path);
                        let name = format!("/tmp/pic/{}.svg", path.rsplit('/').next().unwrap_or_default());
                        let _ = std::fs::write(name, svg);
                    }
                    Err(e) => println!("{e}"),
                }
            }
            Err(e) => println!("{path}: {e}"),
        }
    }
}
