//! Plots: from values to pixels.

use std::fmt::Write;

/// The values between which a plot runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Range {
    /// The smallest.
    pub(crate) low: f64,
    /// The largest.
    pub(crate) high: f64,
}

impl Range {
    /// The range of `values`; none when there are none.
    pub(crate) fn of(values: impl Iterator<Item = f64>) -> Option<Self> {
        values.filter(|value| value.is_finite()).fold(None, |range: Option<Self>, value| {
            let range = range.unwrap_or(Self { low: value, high: value });
            Some(Self { low: range.low.min(value), high: range.high.max(value) })
        })
    }

    /// How far it reaches; never zero.
    pub(crate) fn length(self) -> f64 {
        let length = self.high - self.low;
        if length > 0.0 { length } else { 1.0 }
    }

    /// The range around the same middle, `length` long.
    fn with_length(self, length: f64) -> Self {
        let middle = f64::midpoint(self.low, self.high);
        Self { low: middle - length / 2.0, high: middle + length / 2.0 }
    }
}

/// A plane in pixels: `x` to the right, `y` up, both in the same scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Plane {
    x: Range,
    y: Range,
    width: f64,
    height: f64,
    margin: f64,
}

impl Plane {
    /// A plane that shows both ranges in `width` by `height` pixels, without distorting them.
    pub(crate) fn new(x: Range, y: Range, (width, height): (f64, f64), margin: f64) -> Self {
        let inner = |length: f64| (length - 2.0 * margin).max(1.0);
        let per_pixel = (x.length() / inner(width)).max(y.length() / inner(height));
        let (x, y) = (x.with_length(per_pixel * inner(width)), y.with_length(per_pixel * inner(height)));
        Self { x, y, width, height, margin }
    }

    /// Where a point is.
    pub(crate) fn place(&self, (x, y): (f64, f64)) -> (f64, f64) {
        let scale = self.scale();
        (self.margin + (x - self.x.low) * scale, self.height - self.margin - (y - self.y.low) * scale)
    }

    /// Pixels per unit.
    pub(crate) fn scale(&self) -> f64 {
        (self.width - 2.0 * self.margin) / self.x.length()
    }
}

/// The line through `points`, broken where one is missing, as the `d` of an SVG path.
pub(crate) fn line(points: impl Iterator<Item = Option<(f64, f64)>>) -> String {
    let mut path = String::new();
    let mut drawing = false;
    for point in points {
        if let Some((x, y)) = point {
            let step = if drawing { 'L' } else { 'M' };
            // Writing to a string cannot fail.
            let _ = write!(path, "{step}{x:.1} {y:.1}");
        }
        drawing = point.is_some();
    }
    path
}

/// Dots at `points`: lines of no length, which round ends make visible.
pub(crate) fn dots(points: impl Iterator<Item = (f64, f64)>) -> String {
    points.fold(String::new(), |mut path, (x, y)| {
        let _ = write!(path, "M{x:.1} {y:.1}h0");
        path
    })
}

/// A round length of about a quarter of `length`, for a scale bar: 1, 2 or 5 times a power of ten.
pub(crate) fn round_length(length: f64) -> f64 {
    let about = length / 4.0;
    let power = 10_f64.powf(about.log10().floor());
    let step = [5.0, 2.0, 1.0].into_iter().find(|step| step * power <= about).unwrap_or(1.0);
    step * power
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plane_keeps_the_shape_of_what_it_shows() {
        let (wide, high) = (Range { low: 0.0, high: 2.0 }, Range { low: 0.0, high: 1.0 });
        let plane = Plane::new(wide, high, (220.0, 220.0), 10.0);
        assert_eq!(plane.scale().to_string(), "100");
        assert_eq!(plane.place((0.0, 0.5)), (10.0, 110.0));
        assert_eq!(plane.place((2.0, 0.5)), (210.0, 110.0));
    }

    #[test]
    fn a_line_is_broken_where_a_value_is_missing() {
        let points = [Some((0.0, 1.0)), Some((1.0, 1.0)), None, Some((3.0, 1.0))];
        assert_eq!(line(points.into_iter()), "M0.0 1.0L1.0 1.0M3.0 1.0");
    }

    #[test]
    fn scale_bars_have_round_lengths() {
        assert_eq!([0.9, 1.0, 4.0, 30.0].map(|x| round_length(x).to_string()), ["0.2", "0.2", "1", "5"]);
    }
}
