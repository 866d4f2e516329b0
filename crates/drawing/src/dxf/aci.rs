//! Colours by their number: the AutoCAD colour index.

use crate::Color;

/// The first nine colours: the corners of the colour cube and two greys.
const NAMED: [[u8; 3]; 9] = [
    [255, 0, 0],
    [255, 255, 0],
    [0, 255, 0],
    [0, 255, 255],
    [0, 0, 255],
    [255, 0, 255],
    [255, 255, 255],
    [128, 128, 128],
    [192, 192, 192],
];

/// Brightness of colours 10 to 249 by half of their last digit, percent.
const BRIGHTNESS: [u32; 5] = [100, 65, 50, 30, 15];

/// Colours 250 to 255: greys.
const GREYS: [u8; 6] = [51, 91, 132, 173, 214, 255];

/// The colour of that number; none but for 1 to 255. Number 7, black on paper and white on a dark screen, is white.
///
/// From 10 on the tens stand for 24 hues, 15° each from red on; an odd number is half as strong as the even one
/// before it.
pub(super) fn color_of_index(index: i64) -> Option<Color> {
    let index = usize::try_from(index).ok().filter(|&index| (1..=255).contains(&index))?;
    let [red, green, blue] = match index {
        1..=9 => NAMED[index - 1],
        250.. => [GREYS[index - 250]; 3],
        _ => {
            let (hue, shade) = (index / 10 - 1, index % 10);
            [0, 8, 16].map(|peak| part(hue.abs_diff(peak).min(24 - hue.abs_diff(peak)), shade))
        }
    };
    Some(Color { red, green, blue })
}

/// One part of a colour, so many steps of 15° away from the hue where that part is strongest.
fn part(steps_away: usize, shade: usize) -> u8 {
    // In quarters: full within 60°, none beyond 120°.
    let pure = 8_u32.saturating_sub(steps_away as u32).min(4);
    let strength = if shade.is_multiple_of(2) { pure * 2 } else { 4 + pure };
    (255 * BRIGHTNESS[shade / 2] * strength / 800) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_those_of_the_published_table() {
        for (index, text) in [
            (1, "#ff0000"),
            (7, "#ffffff"),
            (8, "#808080"),
            (10, "#ff0000"),
            (11, "#ff7f7f"),
            (12, "#a50000"),
            (19, "#261313"),
            (22, "#a52900"),
            (43, "#a59152"),
            (90, "#00ff00"),
            (140, "#00bfff"),
            (179, "#131326"),
            (203, "#9152a5"),
            (249, "#261317"),
            (255, "#ffffff"),
        ] {
            assert_eq!(color_of_index(index).unwrap().to_string(), text, "{index}");
        }
        for index in [0, -1, 256, 257, i64::MAX, i64::MIN] {
            assert_eq!(color_of_index(index), None);
        }
    }
}
