//! The curves of growth as an SVG that is readable on light and on dark paper.

use std::fmt::Write as _;

use super::{Curve, Whose};

/// Sizes in pixels: the plot, and around it the room for ticks and names.
const WIDTH: f64 = 480.0;
const HEIGHT: f64 = 340.0;
const LEFT: f64 = 70.0;
const TOP: f64 = 40.0;
const RIGHT: f64 = 270.0;
const BOTTOM: f64 = 60.0;

/// Least distance of two names beside the plot.
const LINE: f64 = 17.0;

/// Strokes for curves, told apart by their color and, where colors look alike, by their place.
const COLORS: usize = 4;

const STYLE: &str = "\
text { font: 13px system-ui, sans-serif; fill: #1f2328; }
.title { font-weight: 600; }
.grid { stroke: #8c959f; stroke-opacity: .35; }
.curve { fill: none; stroke-width: 2.5; }
.peers { stroke-dasharray: 2 5; stroke-linecap: round; }
.lead { stroke: #8c959f; stroke-opacity: .6; }
.c0 { stroke: #0a58ca; } .c1 { stroke: #b3261e; } .c2 { stroke: #1a7f37; } .c3 { stroke: #8250df; }
@media (prefers-color-scheme: dark) {
  text { fill: #e6edf3; }
  .c0 { stroke: #6cb2ff; } .c1 { stroke: #ff8b82; } .c2 { stroke: #56d364; } .c3 { stroke: #c9a5ff; }
}";

/// The chart: how many times as long a curve takes as the first one does for the fewest points, on logarithmic axes. None
/// where there is nothing to draw.
pub(super) fn draw(curves: &[Curve]) -> Option<String> {
    let unit = curves.first()?.times.first()?.1;
    let scale = Scale::around(curves, unit)?;
    let (width, height) = (LEFT + WIDTH + RIGHT, TOP + HEIGHT + BOTTOM);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" \
         height=\"{height}\" role=\"img\" aria-labelledby=\"title\">\n<style>\n{STYLE}\n</style>\n\
         <text id=\"title\" class=\"title\" x=\"{LEFT}\" y=\"20\">Time to cluster, by number of points</text>\n"
    );
    scale.draw_grid(&mut svg);
    let mut names = Vec::new();
    for (index, curve) in curves.iter().enumerate() {
        let class = class(curves, index);
        let points: Vec<(f64, f64)> =
            curve.times.iter().map(|&(size, seconds)| scale.point(size as f64, seconds / unit)).collect();
        let text: Vec<String> = points.iter().map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
        let _ = writeln!(svg, "<polyline class=\"curve {class}\" points=\"{}\"/>", text.join(" "));
        if let Some(&(x, y)) = points.last() {
            names.push(Name { text: &curve.name, class, from: (x, y), y });
        }
    }
    spread(&mut names);
    for name in &names {
        name.draw(&mut svg);
    }
    svg.push_str("</svg>\n");
    Some(svg)
}

/// A curve and its peers have one color; peers are dotted.
fn class(curves: &[Curve], index: usize) -> String {
    let kind = |curve: &Curve| curve.name.rsplit(", ").next().unwrap_or_default().to_owned();
    let mut kinds: Vec<String> = Vec::new();
    for curve in curves {
        if !kinds.contains(&kind(curve)) {
            kinds.push(kind(curve));
        }
    }
    let color = kinds.iter().position(|it| *it == kind(&curves[index])).unwrap_or(0) % COLORS;
    match curves[index].whose {
        Whose::Ours => format!("c{color}"),
        Whose::Peers => format!("c{color} peers"),
    }
}

/// Decades of both axes.
struct Scale {
    sizes: (i32, i32),
    multiples: (i32, i32),
}

impl Scale {
    fn around(curves: &[Curve], unit: f64) -> Option<Self> {
        let all = || curves.iter().flat_map(|curve| &curve.times);
        Some(Self {
            sizes: decades(all().map(|&(size, _)| size as f64))?,
            multiples: decades(all().map(|&(_, seconds)| seconds / unit))?,
        })
    }

    fn point(&self, size: f64, multiple: f64) -> (f64, f64) {
        let share = |value: f64, (first, last): (i32, i32)| {
            (value.log10() - f64::from(first)) / f64::from((last - first).max(1))
        };
        (LEFT + WIDTH * share(size, self.sizes), TOP + HEIGHT * (1.0 - share(multiple, self.multiples)))
    }

    fn draw_grid(&self, svg: &mut String) {
        let (right, bottom) = (LEFT + WIDTH, TOP + HEIGHT);
        for decade in self.sizes.0..=self.sizes.1 {
            let x = self.point(10_f64.powi(decade), 1.0).0;
            let _ = writeln!(
                svg,
                "<line class=\"grid\" x1=\"{x:.1}\" y1=\"{TOP}\" x2=\"{x:.1}\" y2=\"{bottom}\"/>"
            );
            let _ = writeln!(
                svg,
                "<text x=\"{x:.1}\" y=\"{}\" text-anchor=\"middle\">{}</text>",
                bottom + 20.0,
                ten(decade)
            );
        }
        for decade in self.multiples.0..=self.multiples.1 {
            let y = self.point(1.0, 10_f64.powi(decade)).1;
            let _ = writeln!(
                svg,
                "<line class=\"grid\" x1=\"{LEFT}\" y1=\"{y:.1}\" x2=\"{right}\" y2=\"{y:.1}\"/>"
            );
            let _ = writeln!(
                svg,
                "<text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
                LEFT - 8.0,
                y + 4.0,
                ten(decade)
            );
        }
        let _ = writeln!(
            svg,
            "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">points</text>\n\
             <text transform=\"translate(18 {}) rotate(-90)\" text-anchor=\"middle\">\
             times as long as our first point</text>",
            LEFT + WIDTH / 2.0,
            bottom + 44.0,
            TOP + HEIGHT / 2.0
        );
    }
}

/// The decades around positive values; at least one apart.
fn decades(values: impl Iterator<Item = f64> + Clone) -> Option<(i32, i32)> {
    let least = values.clone().min_by(f64::total_cmp)?.log10();
    let most = values.max_by(f64::total_cmp)?.log10();
    // A whole decade stays one whatever the last bit of its logarithm is.
    let (first, last) = ((least + 1e-9).floor() as i32, (most - 1e-9).ceil() as i32);
    Some((first, last.max(first + 1)))
}

fn ten(decade: i32) -> String {
    match decade {
        0 => "1".to_owned(),
        1 => "10".to_owned(),
        _ => format!("10<tspan dy=\"-5\" font-size=\"10\">{decade}</tspan>"),
    }
}

/// What a curve is called, beside its end.
struct Name<'a> {
    text: &'a str,
    class: String,
    from: (f64, f64),
    y: f64,
}

impl Name<'_> {
    fn draw(&self, svg: &mut String) {
        let (x, text) = (LEFT + WIDTH + 14.0, self.text);
        let (from_x, from_y) = self.from;
        let _ = writeln!(
            svg,
            "<line class=\"lead\" x1=\"{:.1}\" y1=\"{from_y:.1}\" x2=\"{x}\" y2=\"{:.1}\"/>\n\
             <line class=\"curve {}\" x1=\"{}\" y1=\"{:.1}\" x2=\"{}\" y2=\"{:.1}\"/>\n\
             <text x=\"{}\" y=\"{:.1}\">{text}</text>",
            from_x + 4.0,
            self.y,
            self.class,
            x + 2.0,
            self.y,
            x + 20.0,
            self.y,
            x + 26.0,
            self.y + 4.0
        );
    }
}

/// Moves names apart: from the lowest upwards, and down again those that would end above the plot.
fn spread(names: &mut [Name]) {
    names.sort_by(|a, b| b.y.total_cmp(&a.y));
    let mut free = TOP + HEIGHT + LINE;
    for name in names.iter_mut() {
        name.y = name.y.min(free - LINE);
        free = name.y;
    }
    let mut taken = TOP - LINE;
    for name in names.iter_mut().rev() {
        name.y = name.y.max(taken + LINE);
        taken = name.y;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(name: &str, whose: Whose, times: &[(usize, f64)]) -> Curve {
        Curve { name: name.to_owned(), whose, times: times.to_vec() }
    }

    #[test]
    fn a_curve_goes_from_corner_to_corner_of_its_decades() {
        let svg = draw(&[curve("rests", Whose::Ours, &[(10_000, 0.5), (100_000, 5.0)])]).unwrap();
        let corners = format!("points=\"{LEFT:.1},{:.1} {:.1},{TOP:.1}\"", TOP + HEIGHT, LEFT + WIDTH);
        assert!(svg.contains(&corners), "{svg}");
        assert_eq!(draw(&[]), None);
    }

    #[test]
    fn a_peer_is_dotted_in_the_color_of_the_same_points() {
        let curves = [
            curve("rests", Whose::Ours, &[]),
            curve("uniform", Whose::Ours, &[]),
            curve("scikit-learn, uniform", Whose::Peers, &[]),
        ];
        assert_eq!([0, 1, 2].map(|index| class(&curves, index)), ["c0", "c1", "c1 peers"]);
    }

    #[track_caller]
    fn check_spread(heights: [f64; 4], expected: [&str; 4]) {
        let mut names = heights.map(|y| Name { text: "", class: String::new(), from: (0.0, y), y });
        spread(&mut names);
        assert_eq!(names.map(|name| name.y.to_string()), expected);
    }

    #[test]
    fn names_do_not_overlap() {
        check_spread([100.0, 101.0, 300.0, 102.0], ["300", "102", "85", "68"]);
    }

    #[test]
    fn names_stay_beside_the_plot() {
        check_spread([TOP, TOP + 1.0, TOP + 2.0, 300.0], ["300", "74", "57", "40"]);
    }
}
