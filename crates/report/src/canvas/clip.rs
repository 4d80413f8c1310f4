//! Lines cut at a frame, and into dashes.

use super::{Frame, Point};

/// The pieces of a line that lie inside a frame (Liang–Barsky, segment by segment).
pub(super) fn polyline(points: &[Point], frame: Frame) -> Vec<Vec<Point>> {
    let mut pieces: Vec<Vec<Point>> = Vec::new();
    for pair in points.windows(2) {
        let Some([from, to]) = segment(pair[0], pair[1], frame) else { continue };
        match pieces.last_mut() {
            Some(piece) if piece.last() == Some(&from) => piece.push(to),
            _ => pieces.push(vec![from, to]),
        }
    }
    pieces
}

fn segment(from: Point, to: Point, frame: Frame) -> Option<[Point; 2]> {
    if !from.iter().chain(&to).all(|v| v.is_finite()) {
        return None;
    }
    let delta = [to[0] - from[0], to[1] - from[1]];
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    let limits = [[frame.x, frame.right()], [frame.y, frame.bottom()]];
    for axis in 0..2 {
        let [low, high] = limits[axis];
        if delta[axis] == 0.0 {
            if from[axis] < low || from[axis] > high {
                return None;
            }
            continue;
        }
        let (a, b) = ((low - from[axis]) / delta[axis], (high - from[axis]) / delta[axis]);
        enter = enter.max(a.min(b));
        leave = leave.min(a.max(b));
    }
    let at = |t: f64| [from[0] + t * delta[0], from[1] + t * delta[1]];
    let start = if enter == 0.0 { from } else { at(enter) };
    let end = if leave >= 1.0 { to } else { at(leave) };
    (enter < leave).then_some([start, end])
}

/// A line cut into dashes of a length, with gaps between them.
pub(super) fn dashes(points: &[Point], dash: f64, gap: f64) -> Vec<Vec<Point>> {
    let mut pieces = Vec::new();
    let mut current: Vec<Point> = points.first().copied().into_iter().collect();
    let mut drawing = true;
    let mut left = dash;
    for pair in points.windows(2) {
        let [mut from, to] = [pair[0], pair[1]];
        loop {
            let length = (to[0] - from[0]).hypot(to[1] - from[1]);
            if length <= left {
                left -= length;
                if drawing {
                    current.push(to);
                }
                break;
            }
            let t = left / length;
            from = [from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])];
            if drawing {
                current.push(from);
                pieces.push(std::mem::take(&mut current));
            } else {
                current.push(from);
            }
            drawing = !drawing;
            left = if drawing { dash } else { gap };
        }
    }
    if current.len() > 1 {
        pieces.push(current);
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRAME: Frame = Frame::new(0.0, 0.0, 10.0, 10.0);

    #[test]
    fn a_line_that_leaves_and_returns_has_two_pieces() {
        let pieces = polyline(&[[5.0, 5.0], [5.0, 15.0], [8.0, 15.0], [8.0, 5.0]], FRAME);
        assert_eq!(pieces, [[[5.0, 5.0], [5.0, 10.0]], [[8.0, 10.0], [8.0, 5.0]]]);
    }

    #[test]
    fn a_line_outside_or_of_no_numbers_has_none() {
        assert!(polyline(&[[-5.0, 0.0], [-1.0, 9.0]], FRAME).is_empty());
        assert!(polyline(&[[f64::NAN, 0.0], [1.0, 9.0]], FRAME).is_empty());
    }

    #[test]
    fn dashes_go_round_corners() {
        let pieces = dashes(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0]], 3.0, 2.0);
        assert_eq!(pieces, [[[0.0, 0.0], [3.0, 0.0]], [[4.0, 1.0], [4.0, 4.0]]]);
    }
}
