//! Text in the embedded font, with subscripts.

use super::Style;
use plotters::style::{FontDesc, FontFamily, FontStyle, register_font};
use std::sync::Once;

/// The name the embedded font has in SVG files, so that viewers that have it
/// take it.
pub(super) const FONT: &str = "DejaVu Sans";
/// Ascent plus descent of DejaVu Sans in ems; plotters' sizes are this height.
pub(super) const FONT_HEIGHT_EM: f64 = 2384.0 / 2048.0;

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
        /// Sizes are whole pixels in plotters; measuring large keeps the fractions.
        const MEASURING_EM: f64 = 1000.0;
        let font = font(MEASURING_EM * FONT_HEIGHT_EM, self.style.bold);
        let width = font.layout_box(&self.text).map_or(0, |((left, _), (right, _))| right - left);
        f64::from(width) * self.style.size / MEASURING_EM
    }
}

/// The embedded font at a height in pixels.
pub(super) fn font(height: f64, bold: bool) -> FontDesc<'static> {
    static REGISTERED: Once = Once::new();
    REGISTERED.call_once(|| {
        let regular = include_bytes!("../../assets/fonts/DejaVuSans-subset.ttf");
        let heavy = include_bytes!("../../assets/fonts/DejaVuSans-Bold-subset.ttf");
        for (style, bytes) in [(FontStyle::Normal, &regular[..]), (FontStyle::Bold, &heavy[..])] {
            assert!(register_font(FONT, style, bytes).is_ok(), "the embedded font is broken");
        }
    });
    let style = if bold { FontStyle::Bold } else { FontStyle::Normal };
    FontDesc::new(FontFamily::Name(FONT), height, style)
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
        runs.push(Run { text: text.to_owned(), style: Style { size, ..style }, drop });
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
            ["J", "d", " = 36"]
        );
        assert!(runs[1].style.size < 10.0 && runs[1].drop > 0.0);
    }

    #[test]
    fn every_sign_the_figures_use_is_in_the_font() {
        let signs = "λ₂τΩ°×±·–—−≥≤µ′″…₀₁₉²⁻¹ N E é ü ";
        let width =
            |text: &str| Run { text: text.into(), style: Style::new(10.0, INK), drop: 0.0 }.width();
        let missing = width("\u{e000}");
        for sign in signs.chars().filter(|c| *c != ' ') {
            let font_width = width(&sign.to_string());
            assert!(font_width > 0.0, "{sign}");
            assert!((font_width - missing).abs() > 1e-9, "{sign} is drawn as a box");
        }
    }
}
