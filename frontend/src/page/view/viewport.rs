//! How a drawing lies in its frame: fit, zoom, and bringing things into view.

use goalgraph::layout::{Point, Rect};
use leptos::prelude::*;

use crate::page::model::{Selection, Viewport};
use crate::page::update::App;

/// How much one step of a key zooms.
pub(crate) const ZOOM_STEP: f64 = 1.25;
const SCALES: std::ops::RangeInclusive<f64> = 0.02..=4.0;
/// Small graphs are not blown up further than this.
const LARGEST_FIT: f64 = 1.4;
const MARGIN: f64 = 28.0;

impl Viewport {
    /// Where a place of the frame is in the drawing.
    pub(crate) fn in_drawing(self, place: Point) -> Point {
        Point::new((place.x - self.x) / self.scale, (place.y - self.y) / self.scale)
    }

    /// Where a place of the drawing is in the frame.
    pub(crate) fn in_frame(self, place: Point) -> Point {
        Point::new(place.x * self.scale + self.x, place.y * self.scale + self.y)
    }

    /// The part of the drawing that a frame of this width and height shows.
    pub(crate) fn shown(self, (width, height): (f64, f64)) -> Rect {
        let (top_left, bottom_right) =
            (self.in_drawing(Point::new(0.0, 0.0)), self.in_drawing(Point::new(width, height)));
        Rect { left: top_left.x, top: top_left.y, right: bottom_right.x, bottom: bottom_right.y }
    }
}

/// Shows the whole drawing.
pub(crate) fn fit(app: App) {
    match app.derived.picture.get_untracked() {
        Some(picture) => {
            look_at(app, picture.bounds());
            app.model.fitted.set(true);
        }
        None => app.model.viewport.set(None),
    }
}

/// Shows these parts of the drawing, as large as can be.
pub(crate) fn show(app: App, items: &[Selection]) {
    let Some(picture) = app.derived.picture.get_untracked() else { return };
    let mut boxes = items.iter().flat_map(|item| {
        let ends = match *item {
            Selection::State(id) => [Some(id), None],
            Selection::Transition(source, symbol) => {
                [Some(source), picture.edge(source, symbol).map(|edge| edge.target)]
            }
        };
        ends.into_iter().flatten().filter_map(|id| picture.node_rect(id)).collect::<Vec<_>>()
    });
    if let Some(first) = boxes.next() {
        look_at(app, boxes.fold(first, union));
    }
}

fn union(a: Rect, b: Rect) -> Rect {
    Rect {
        left: a.left.min(b.left),
        top: a.top.min(b.top),
        right: a.right.max(b.right),
        bottom: a.bottom.max(b.bottom),
    }
}

/// Puts the frame around a part of the drawing.
fn look_at(app: App, rect: Rect) {
    let (width, height) = app.model.frame.get_untracked();
    if width <= 0.0 || height <= 0.0 {
        return app.model.viewport.set(None);
    }
    let room = |length: f64| (length - 2.0 * MARGIN).max(1.0);
    let (wide, high) = ((rect.right - rect.left).max(1.0), (rect.bottom - rect.top).max(1.0));
    let scale = (room(width) / wide).min(room(height) / high).clamp(*SCALES.start(), LARGEST_FIT);
    app.model.fitted.set(false);
    let x = (width - (rect.left + rect.right) * scale) / 2.0;
    let y = (height - (rect.top + rect.bottom) * scale) / 2.0;
    app.model.viewport.set(Some(Viewport { scale, x, y }));
}

/// Brings a place of the drawing into the frame when it is outside, so that what has the focus is seen.
pub(crate) fn reveal(app: App, place: Point) {
    let (width, height) = app.model.frame.get_untracked();
    let Some(viewport) = app.model.viewport.get_untracked() else { return };
    let inside = |place: f64, length: f64| (MARGIN..=length - MARGIN).contains(&place);
    let Point { x: left, y: top } = viewport.in_frame(place);
    if !inside(left, width) || !inside(top, height) {
        let (x, y) = (viewport.x + width / 2.0 - left, viewport.y + height / 2.0 - top);
        app.model.viewport.set(Some(Viewport { x, y, ..viewport }));
    }
}

/// Zooms at the middle of the frame.
pub(crate) fn zoom(app: App, factor: f64) {
    let (width, height) = app.model.frame.get_untracked();
    zoom_at(app, factor, Point::new(width / 2.0, height / 2.0));
}

/// Zooms so that what is at a point of the frame stays there.
pub(crate) fn zoom_at(app: App, factor: f64, place: Point) {
    app.model.fitted.set(false);
    app.model.viewport.update(|viewport| {
        let Some(viewport) = viewport else { return };
        let scale = (viewport.scale * factor).clamp(*SCALES.start(), *SCALES.end());
        let factor = scale / viewport.scale;
        let shifted = |place: f64, origin: f64| place - (place - origin) * factor;
        *viewport = Viewport { scale, x: shifted(place.x, viewport.x), y: shifted(place.y, viewport.y) };
    });
}

/// Moves the drawing by pixels of the frame.
pub(crate) fn pan(app: App, dx: f64, dy: f64) {
    app.model.fitted.set(false);
    app.model.viewport.update(|viewport| {
        if let Some(viewport) = viewport {
            viewport.x += dx;
            viewport.y += dy;
        }
    });
}
