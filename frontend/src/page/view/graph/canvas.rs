//! A large automaton, painted: thousands of states and transitions at once, without an element for each.

use goalgraph::layout::{CubicBezier, Point, Rect};
use goalgraph::pdfa::{StateId, Symbol};
use leptos::html::Canvas;
use leptos::prelude::*;
use wasm_bindgen::JsCast;
use web_sys::{CanvasRenderingContext2d, HtmlCanvasElement, HtmlElement};

use super::view_part::ViewPart;
use crate::page::derived::Picture;
use crate::page::model::Viewport;
use crate::page::update::App;

/// What is painted, and where. It fills the frame below the drawing.
pub(super) fn canvas(app: App, part: Memo<ViewPart>) -> impl IntoView {
    let node = NodeRef::<Canvas>::new();
    Effect::new(move |_| {
        let (frame, viewport) = (app.model.frame.get(), app.model.viewport.get());
        // The colors are those of the style sheet.
        app.model.theme.track();
        let painted = part.with(|part| part.painted);
        let (Some(canvas), Some(picture), Some(viewport)) = (node.get(), app.derived.picture.get(), viewport)
        else {
            return;
        };
        let pixels = window().device_pixel_ratio();
        canvas.set_width((frame.0 * pixels) as u32);
        canvas.set_height((frame.1 * pixels) as u32);
        if let Some(context) = context_of(&canvas).filter(|_| painted) {
            // Scaling and moving a context cannot fail.
            let _ = context.scale(pixels, pixels);
            let _ = context.translate(viewport.x, viewport.y);
            let _ = context.scale(viewport.scale, viewport.scale);
            app.derived.residue.with(|hidden| {
                let shown = viewport.shown(frame);
                let paint = Paint { canvas: &canvas, context: &context, viewport, shown };
                paint.transitions(&picture, &|edge| !hidden.transitions.contains(&edge));
                paint.states(&picture, &|id| !hidden.states.contains(&id));
            });
        }
    });
    view! { <canvas node_ref=node class="paint" aria-hidden="true"></canvas> }
}

fn context_of(canvas: &HtmlCanvasElement) -> Option<CanvasRenderingContext2d> {
    canvas.get_context("2d").ok().flatten()?.dyn_into().ok()
}

/// A painter in the drawing space.
struct Paint<'a> {
    canvas: &'a HtmlCanvasElement,
    context: &'a CanvasRenderingContext2d,
    viewport: Viewport,
    shown: Rect,
}

impl Paint<'_> {
    /// All lines are one path: that is what makes thousands of them quick.
    fn transitions(&self, picture: &Picture, drawn: &dyn Fn((StateId, Symbol)) -> bool) {
        self.context.begin_path();
        for edge in picture.layout.edges.iter().filter(|edge| drawn((edge.source, edge.symbol))) {
            for curve in edge.path.iter().filter(|curve| self.touches(curve)) {
                let CubicBezier { start, control_1, control_2, end } = curve;
                self.context.move_to(start.x, start.y);
                self.context.bezier_curve_to(
                    control_1.x,
                    control_1.y,
                    control_2.x,
                    control_2.y,
                    end.x,
                    end.y,
                );
            }
        }
        self.context.set_stroke_style_str(&self.color("--line-strong"));
        self.context.set_global_alpha(if self.viewport.scale < 0.15 { 0.25 } else { 0.6 });
        self.context.set_line_width(1.0 / self.viewport.scale.min(1.0));
        self.context.stroke();
        self.context.set_global_alpha(1.0);
    }

    fn states(&self, picture: &Picture, drawn: &dyn Fn(StateId) -> bool) {
        self.context.begin_path();
        for (_, rect) in picture.states().filter(|(id, rect)| drawn(*id) && touch(rect, &self.shown)) {
            self.context.rect(rect.left, rect.top, rect.right - rect.left, rect.bottom - rect.top);
        }
        self.context.set_fill_style_str(&self.color("--raised"));
        self.context.fill();
        self.context.set_stroke_style_str(&self.color("--text-soft"));
        self.context.set_line_width(1.0 / self.viewport.scale.min(1.0));
        self.context.stroke();
        if self.viewport.scale >= 0.1 {
            self.names(picture, drawn);
        }
    }

    fn names(&self, picture: &Picture, drawn: &dyn Fn(StateId) -> bool) {
        self.context.set_fill_style_str(&self.color("--text"));
        self.context.set_text_align("center");
        self.context.set_text_baseline("middle");
        let size = (11.0 / self.viewport.scale).clamp(11.0, 26.0);
        self.context.set_font(&format!("{size:.0}px system-ui, sans-serif"));
        for node in picture.layout.nodes.iter().filter(|node| drawn(node.id)) {
            // Text outside the frame is just not seen.
            let _ = self.context.fill_text(&node.id.to_string(), node.x, node.y);
        }
    }

    /// A color of the style sheet. A token is read as it is written, with `light-dark()` in it; the color of an element
    /// is what comes of it, so the canvas takes it on.
    fn color(&self, token: &str) -> String {
        // Without a style there is nothing to read either: what is painted is then black.
        let _ = HtmlElement::style(self.canvas).set_property("color", &format!("var({token})"));
        let style = window().get_computed_style(self.canvas).ok().flatten();
        style.and_then(|style| style.get_property_value("color").ok()).unwrap_or_default()
    }

    fn touches(&self, curve: &CubicBezier) -> bool {
        let points = [curve.start, curve.control_1, curve.control_2, curve.end];
        let low = |value: fn(&Point) -> f64| points.iter().map(value).fold(f64::INFINITY, f64::min);
        let high = |value: fn(&Point) -> f64| points.iter().map(value).fold(f64::NEG_INFINITY, f64::max);
        let rect =
            Rect { left: low(|p| p.x), top: low(|p| p.y), right: high(|p| p.x), bottom: high(|p| p.y) };
        touch(&rect, &self.shown)
    }
}

fn touch(a: &Rect, b: &Rect) -> bool {
    a.left <= b.right && b.left <= a.right && a.top <= b.bottom && b.top <= a.bottom
}
