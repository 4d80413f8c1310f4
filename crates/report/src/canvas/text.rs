//! Text in the embedded font, with subscripts.

use super::Style;
use ab_glyph::{Font, FontRef, ScaleFont, point};
use std::sync::LazyLock;

/// The name the embedded font has in SVG files, so that viewers that have it
/// take it.
pub(super) const FONT: &str = "DejaVu Sans";
/// Ascent plus descent of `DejaVu` Sans in ems; sizes of fonts are this height.
const FONT_HEIGHT_EM: f64 = 2384.0 / 2048.0;

const SUBSCRIPT_SIZE: f64 = 0.72;
const SUBSCRIPT_DROP: f64 = 0.22;

/// A piece of text on one baseline.
pub(super) struct Run {
    pub(super) text: String,
    pub(super) style: Style,
    /// How far the baseline lies below the line's, in points.
    pub(super) drop: f64,
}

impl Run {
    /// Advance width, in points.
    pub(super) fn width(&self) -> f64 {
        let face = face(self.style.bold).as_scaled((self.style.size * FONT_HEIGHT_EM) as f32);
        self.text.chars().map(|c| f64::from(face.h_advance(face.glyph_id(c)))).sum()
    }

    /// Rasterises the text: `pixel` gets how far right and down of the
    /// baseline's start each touched pixel is, and how much of it is covered.
    ///
    /// plotters' own text leaves out the glyphs' side bearings.
    pub(super) fn cover(
        &self,
        pixels_per_point: f64,
        mut pixel: impl FnMut(i32, i32, f64) -> Result<(), String>,
    ) -> Result<(), String> {
        let height = self.style.size * pixels_per_point * FONT_HEIGHT_EM;
        let face = face(self.style.bold).as_scaled(height as f32);
        let mut pen = 0.0;
        for c in self.text.chars() {
            let mut glyph = face.scaled_glyph(c);
            glyph.position = point(pen, 0.0);
            pen += face.h_advance(glyph.id);
            let Some(outline) = face.outline_glyph(glyph) else { continue };
            let bounds = outline.px_bounds();
            let (left, top) = (bounds.min.x as i32, bounds.min.y as i32);
            let mut drawn = Ok(());
            outline.draw(|x, y, coverage| {
                if coverage > 0.0 && drawn.is_ok() {
                    let coverage = f64::from(coverage).min(1.0);
                    drawn = pixel(left + x as i32, top + y as i32, coverage);
                }
            });
            drawn?;
        }
        Ok(())
    }
}

/// The embedded font.
fn face(bold: bool) -> &'static FontRef<'static> {
    static REGULAR: LazyLock<FontRef<'static>> =
        LazyLock::new(|| parsed(include_bytes!("../../assets/fonts/DejaVuSans-subset.ttf")));
    static BOLD: LazyLock<FontRef<'static>> =
        LazyLock::new(|| parsed(include_bytes!("../../assets/fonts/DejaVuSans-Bold-subset.ttf")));
    if bold { &BOLD } else { &REGULAR }
}

fn parsed(bytes: &'static [u8]) -> FontRef<'static> {
    FontRef::try_from_slice(bytes).expect("the embedded font is part of the program and tested")
}

/// Splits a text at its subscripts, `_{…}`.
pub(super) fn runs(text: &str, style: Style) -> Vec<Run> {
    let mut runs = Vec::new();
    let mut push = |text: &str, subscript: bool| {
        if text.is_empty() {
            return;
        }
        let (size, drop) = if subscript {
            (style.size * SUBSCRIPT_SIZE, style.size * SUBSCRIPT_DROP)
        } else {
            (style.size, 0.0)
        };
        // XML readers drop spaces at a text's start, but not those that do not break.
        let spaces = text.len() - text.trim_start_matches(' ').len();
        let text = format!("{}{}", "\u{a0}".repeat(spaces), &text[spaces..]);
        runs.push(Run { text, style: Style { size, ..style }, drop });
    };
    let mut rest = text;
    while let Some((before, (subscript, after))) =
        rest.split_once("_{").and_then(|(before, tail)| Some((before, tail.split_once('}')?)))
    {
        push(before, false);
        push(subscript, true);
        rest = after;
    }
    push(rest, false);
    runs
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::colour::INK;

    #[test]
    fn subscripts_are_smaller_and_lower() {
        let runs = runs("J_{d} = 36", Style::new(10.0, INK));
        assert_eq!(
            runs.iter().map(|run| run.text.as_str()).collect::<Vec<_>>(),
            ["J", "d", "\u{a0}= 36"]
        );
        assert!(runs[1].style.size < 10.0 && runs[1].drop > 0.0);
    }

    #[test]
    fn every_sign_the_figures_use_is_in_the_font() {
        let signs = "λ₂τΩ°×±·–—−≥≤µ′″…₀₁₉²⁻¹ N E é ü ";
        for bold in [false, true] {
            for sign in signs.chars() {
                assert_ne!(face(bold).glyph_id(sign).0, 0, "{sign} is not in the font");
            }
        }
    }
}
