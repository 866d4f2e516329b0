//! `traverse inspect`.

use crate::arguments::Inspect;
use crate::drawing_scene;
use crate::failure::Failure;
use crate::picture_file::{PictureKind, write_picture};
use traverse_drawing::{SceneOptions, inspect_drawing, picture_of_drawing};

pub(crate) fn run(arguments: &Inspect) -> Result<(), Failure> {
    let file = &arguments.file;
    let kinds: Vec<PictureKind> =
        arguments.output.iter().map(|path| PictureKind::of(path)).collect::<Result<_, _>>()?;
    let machine = drawing_scene::machine(file)?;
    let mut options = SceneOptions::new(0.0);
    if let Some(machine) = &machine {
        machine.apply_to(&mut options);
    }
    drawing_scene::choose_roles(file, &mut options.roles);
    let drawing = drawing_scene::read(file)?;
    let seen = inspect_drawing(&drawing, &options.roles, file.join);
    say!("file    {}", file.drawing.display());
    if let Some(mapping) = &drawing.mapping {
        say!("page    {mapping}");
    }
    say!("{}", seen.to_string().trim_end());
    let title = file.drawing.file_name().unwrap_or_default().to_string_lossy();
    for (path, kind) in arguments.output.iter().zip(kinds) {
        write_picture(path, kind, &picture_of_drawing(&drawing, &seen.findings, &title), arguments.width)?;
        say!("wrote {}", path.display());
    }
    Ok(())
}
