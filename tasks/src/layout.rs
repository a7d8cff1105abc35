//! The truth of a task: what moves, where to, in which orders.

use crate::geometry::Point;

/// Lengths in metres (radians for an arm).
pub(crate) struct Layout {
    pub(crate) objects: Vec<Object>,
    pub(crate) sites: Vec<Site>,
    pub(crate) orders: Vec<Order>,
}

/// A thing that moves.
pub(crate) struct Object {
    pub(crate) name: String,
    /// Middle of the region in which it waits at first.
    pub(crate) start: Point,
    /// How far from the middle it may wait, along x and along y.
    pub(crate) start_reach: f64,
}

/// A place together with the object that is put there.
pub(crate) struct Site {
    pub(crate) name: String,
    pub(crate) object: usize,
    pub(crate) center: Point,
}

/// A word and how much the experts prefer it.
pub(crate) struct Order {
    /// Indices of sites.
    pub(crate) word: Vec<usize>,
    pub(crate) preference: usize,
}

impl Layout {
    /// Centers of the sites of one object.
    pub(crate) fn centers(&self, object: usize) -> impl Iterator<Item = Point> {
        let own = self.sites.iter().filter(move |site| site.object == object);
        own.map(|site| site.center)
    }

    /// Whether some order leaves out some site.
    pub(crate) fn has_optional_sites(&self) -> bool {
        let all = self.sites.len();
        self.orders.iter().any(|order| order.word.len() < all)
    }
}
