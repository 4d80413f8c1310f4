//! Colours, and cmocean's colour tables (Thyng et al. 2016,
//! doi:10.5670/oceanog.2016.66).

/// A colour, 8 bits each of red, green and blue.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Rgb(pub(crate) u8, pub(crate) u8, pub(crate) u8);

/// Text and frames.
pub(crate) const INK: Rgb = Rgb(0x1f, 0x29, 0x33);
/// Secondary text.
pub(crate) const MUTED: Rgb = Rgb(0x5f, 0x6b, 0x78);
/// Faint lines: bathymetry, grids.
pub(crate) const FAINT: Rgb = Rgb(0xb4, 0xbd, 0xc6);
/// Cells without a value.
pub(crate) const NO_DATA: Rgb = Rgb(0xe3, 0xe5, 0xe8);
/// Hatching of cells without a value, and of blocked cells.
pub(crate) const HATCH: Rgb = Rgb(0xa9, 0xb0, 0xb8);
/// The sea bed in sections.
pub(crate) const SEABED: Rgb = Rgb(0xa8, 0xa0, 0x95);
/// Paper.
pub(crate) const WHITE: Rgb = Rgb(0xff, 0xff, 0xff);
/// What vehicles travelled.
pub(crate) const TRACK: Rgb = Rgb(0x14, 0x5d, 0xa0);
/// What vehicles still have before them.
pub(crate) const PLANNED: Rgb = Rgb(0x6f, 0xa8, 0xdc);
/// Posts.
pub(crate) const POST: Rgb = Rgb(0xd9, 0x5f, 0x0e);
/// Single ones of what the colour of posts shows.
pub(crate) const POST_TINT: Rgb = Rgb(0xf3, 0xb8, 0x8c);
/// What failed.
pub(crate) const FAILURE: Rgb = Rgb(0xb0, 0x1e, 0x3c);
/// Arrows of current.
pub(crate) const CURRENT: Rgb = Rgb(0x8d, 0x99, 0xa6);
/// Methods side by side: Okabe and Ito's colours, told apart whatever one's sight.
pub(crate) const SERIES: [Rgb; 7] = [
    Rgb(0x00, 0x72, 0xb2),
    Rgb(0xd5, 0x5e, 0x00),
    Rgb(0x00, 0x9e, 0x73),
    Rgb(0xcc, 0x79, 0xa7),
    Rgb(0xe6, 0x9f, 0x00),
    Rgb(0x56, 0xb4, 0xe9),
    Rgb(0x5f, 0x6b, 0x78),
];

impl Rgb {
    /// The colour mixed with as much white and a half.
    pub(crate) fn tint(self) -> Self {
        let mixed = |channel: u8| ((u16::from(channel) * 2 + 255 * 3) / 5) as u8;
        Self(mixed(self.0), mixed(self.1), mixed(self.2))
    }
}

/// One of cmocean's colour tables.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ColourTable {
    /// 256 lines `rrggbb`.
    hex: &'static str,
    /// Whether low values take the table's last colours.
    reversed: bool,
}

/// Prior probability of a target.
pub(crate) const AMP: ColourTable =
    ColourTable { hex: include_str!("../assets/colormaps/amp.txt"), reversed: false };
/// Probability of detection.
pub(crate) const DENSE: ColourTable =
    ColourTable { hex: include_str!("../assets/colormaps/dense.txt"), reversed: false };
/// Transmission loss, bright where sound arrives strongest.
pub(crate) const LOSS: ColourTable =
    ColourTable { hex: include_str!("../assets/colormaps/haline.txt"), reversed: true };
/// Sound speed.
pub(crate) const THERMAL: ColourTable =
    ColourTable { hex: include_str!("../assets/colormaps/thermal.txt"), reversed: false };
/// Water depth.
pub(crate) const DEEP: ColourTable =
    ColourTable { hex: include_str!("../assets/colormaps/deep.txt"), reversed: false };
/// Speed of the current.
pub(crate) const SPEED: ColourTable =
    ColourTable { hex: include_str!("../assets/colormaps/speed.txt"), reversed: false };
/// Differences.
pub(crate) const BALANCE: ColourTable =
    ColourTable { hex: include_str!("../assets/colormaps/balance.txt"), reversed: false };

const TABLE_LENGTH: usize = 256;
/// Six digits and the line's end.
const LINE_LENGTH: usize = 7;

impl ColourTable {
    /// The colour at a fraction from 0 to 1 of the table; beyond, its ends.
    pub(crate) fn at(&self, fraction: f64) -> Rgb {
        let index = (fraction.clamp(0.0, 1.0) * (TABLE_LENGTH - 1) as f64).round() as usize;
        let line = if self.reversed { TABLE_LENGTH - 1 - index } else { index } * LINE_LENGTH;
        let channel = |offset: usize| {
            u8::from_str_radix(&self.hex[line + offset..line + offset + 2], 16)
                .expect("embedded colour tables hold hexadecimal digits")
        };
        Rgb(channel(0), channel(2), channel(4))
    }

    /// All colours in order of rising value, six hexadecimal digits each.
    pub(crate) fn to_hex(self) -> String {
        let mut lines: Vec<&str> = self.hex.lines().collect();
        if self.reversed {
            lines.reverse();
        }
        lines.concat()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_table_has_its_256_colours() {
        for table in [AMP, DENSE, LOSS, THERMAL, DEEP, SPEED, BALANCE] {
            assert_eq!(table.to_hex().len(), TABLE_LENGTH * 6);
            for index in 0..TABLE_LENGTH {
                table.at(index as f64 / 255.0);
            }
        }
    }

    #[test]
    fn ends_are_the_tables_ends() {
        assert_eq!(AMP.at(-1.0), Rgb(0xf1, 0xed, 0xec));
        assert_eq!(LOSS.at(2.0), Rgb(0x2a, 0x18, 0x6c));
    }
}
