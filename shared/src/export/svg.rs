//! A drawing of the automaton that stands alone, in a light theme.

mod style;

use self::style::{CHIP_COLORS, STYLE};
use crate::layout::drawing::{
    BOX_RADIUS, CHIP_HEIGHT, Chip, LABEL_LINE_HEIGHT, SECOND_BORDER, color_index, layout_request,
    state_drawing, transition_label,
};
use crate::layout::{ArrowHead, CubicBezier, EdgePath, NodeBox, Point, StartArrow, layout};
use crate::pdfa::Probabilities;
use crate::specification::Specification;

/// Thickness of a line: that of an impossible transition, and what certainty adds.
const THINNEST: f64 = 1.0;
const THICKENING: f64 = 2.2;

/// Half the width of an arrow head, beyond half the thickness of its line.
const HEAD_HALF_WIDTH: f64 = 3.6;

/// The automaton as an SVG image: states with chips for their completed sub-goals, transitions with sub-goal, probability
/// and the number of words that took them, thicker where more probable. Accepting states have two borders.
///
/// Every group is marked with `data-state` or `data-transition` and has a title for readers that cannot see it.
///
/// # Complexity
///
/// That of [`layout`].
pub fn svg(specification: &Specification) -> String {
    let layout = layout(&layout_request(specification));
    let probabilities = specification.pdfa.probabilities(specification.semantics);
    let page = Page { specification, probabilities: &probabilities };
    let (width, height) = (number(layout.width), number(layout.height));
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\" role=\"img\">\n<title>{}</title>\n<style>{STYLE}</style>\n\
         <rect class=\"page\" width=\"{width}\" height=\"{height}\"/>\n",
        escaped(&specification.name)
    );
    text += &layout.start.as_ref().map_or_else(String::new, start_arrow);
    let (edges, nodes) = (&layout.edges, &layout.nodes);
    text.extend(edges.iter().map(|edge| page.transition(edge)));
    text.extend(edges.iter().map(|edge| page.label(edge)));
    text.extend(nodes.iter().map(|node| page.state(node)));
    text + "</svg>\n"
}

/// What everything is drawn from.
struct Page<'a> {
    specification: &'a Specification,
    probabilities: &'a Probabilities,
}

impl Page<'_> {
    fn transition(&self, edge: &EdgePath) -> String {
        let (source, symbol, target) = (edge.source, edge.symbol, edge.target);
        let thickness = THINNEST + THICKENING * self.probabilities.transition(source, symbol);
        let line = path(&edge.path);
        let name = escaped(&self.specification.name_of(symbol));
        let label = transition_label(self.specification, self.probabilities, source, symbol);
        format!(
            "<g data-transition=\"{source} {symbol} {target}\"><title>{name} from {source} to {target}: {}</title>\
             <path class=\"shaft\" stroke-width=\"{}\" d=\"{line}\"/>{}</g>\n",
            escaped(&label.evidence),
            number(thickness),
            head(edge.arrow, thickness),
        )
    }

    fn label(&self, edge: &EdgePath) -> String {
        let label = transition_label(self.specification, self.probabilities, edge.source, edge.symbol);
        let line = |shift: f64| point(Point::new(edge.label.x, edge.label.y + shift));
        let (first, second) = (line(-LABEL_LINE_HEIGHT / 2.0), line(LABEL_LINE_HEIGHT / 2.0));
        let (left, top) = (edge.label.x - label.width / 2.0, edge.label.y - label.height / 2.0);
        let ground =
            format!("<rect class=\"ground\" {} rx=\"4\"/>", frame(left, top, label.width, label.height));
        ground + &text_at("name", &first, &label.name) + &text_at("evidence", &second, &label.evidence) + "\n"
    }

    fn state(&self, node: &NodeBox) -> String {
        let Some(state) = self.specification.pdfa.states.get(&node.id) else {
            return String::new();
        };
        let drawing = state_drawing(self.specification, self.probabilities, node.id, state);
        let at = |offset: Point| point(Point::new(node.x + offset.x, node.y + offset.y));
        let mut text = format!("<g data-state=\"{}\">{}", node.id, border(node, 0.0));
        if drawing.accepting {
            text += &border(node, SECOND_BORDER);
        }
        text += &text_at("id", &at(drawing.title_at), &drawing.title);
        if let Some(note) = drawing.note {
            text += &text_at("note", &at(drawing.note_at), note);
        }
        text.extend(drawing.chips.iter().map(|chip| self.chip(node, chip)));
        text + "</g>\n"
    }

    fn chip(&self, node: &NodeBox, chip: &Chip) -> String {
        let color = CHIP_COLORS[color_index(self.specification, chip.symbol) % CHIP_COLORS.len()];
        let (left, top) = (node.x + chip.rect.left, node.y + chip.rect.top);
        let width = chip.rect.right - chip.rect.left;
        let (frame, radius) = (frame(left, top, width, CHIP_HEIGHT), number(CHIP_HEIGHT / 2.0));
        let center = point(Point::new(left + width / 2.0, top + CHIP_HEIGHT / 2.0));
        let ground = format!("<rect class=\"chip\" fill=\"{color}\" {frame} rx=\"{radius}\"/>");
        ground + &text_at("name", &center, &chip.text)
    }
}

fn start_arrow(start: &StartArrow) -> String {
    let line = format!("M{} L{}", point(start.from), point(start.arrow.base()));
    format!("<path class=\"shaft\" d=\"{line}\"/>{}\n", head(start.arrow, THINNEST))
}

/// Curves that follow each other, as path data.
fn path(curves: &[CubicBezier]) -> String {
    let start = curves.first().map_or_else(String::new, |curve| format!("M{}", point(curve.start)));
    let curve = |curve: &CubicBezier| {
        let controls = [curve.control_1, curve.control_2, curve.end].map(point);
        format!(" C{}", controls.join(" "))
    };
    start + &curves.iter().map(curve).collect::<String>()
}

fn border(node: &NodeBox, inset: f64) -> String {
    let (width, height) = (node.width - 2.0 * inset, node.height - 2.0 * inset);
    let frame = frame(node.x - width / 2.0, node.y - height / 2.0, width, height);
    format!("<rect class=\"box\" {frame} rx=\"{}\"/>", number(BOX_RADIUS - inset))
}

fn frame(x: f64, y: f64, width: f64, height: f64) -> String {
    let [x, y, width, height] = [x, y, width, height].map(number);
    format!("x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"")
}

fn text_at(class: &str, at: &str, content: &str) -> String {
    let (x, y) = at.split_once(' ').unwrap_or((at, "0"));
    format!("<text class=\"{class}\" x=\"{x}\" y=\"{y}\">{}</text>", escaped(content))
}

/// An arrow head at the end of a line of a thickness.
fn head(arrow: ArrowHead, thickness: f64) -> String {
    let (base, half) = (arrow.base(), HEAD_HALF_WIDTH + thickness / 2.0);
    let (x, y) = (-arrow.direction.y * half, arrow.direction.x * half);
    let corners = [Point::new(base.x + x, base.y + y), arrow.tip, Point::new(base.x - x, base.y - y)];
    format!("<path class=\"head\" d=\"M{} Z\"/>", corners.map(point).join(" L"))
}

fn point(point: Point) -> String {
    format!("{} {}", number(point.x), number(point.y))
}

/// A length with up to two digits after the point.
fn number(length: f64) -> String {
    let text = format!("{length:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// Text that is safe between tags and in quoted attributes; characters that XML does not allow are left out.
fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => safe += "&amp;",
            '<' => safe += "&lt;",
            '>' => safe += "&gt;",
            '"' => safe += "&quot;",
            '\n' | '\r' | '\t' => safe.push(' '),
            '\u{0}'..='\u{1f}' | '\u{fffe}' | '\u{ffff}' => {}
            other => safe.push(other),
        }
    }
    safe
}
