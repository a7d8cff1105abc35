//! Names beside places, so that no two overlap and each can be told to which place it belongs.

/// A name that wants to stand beside a place; all in pixels, `y` down.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Label {
    /// What is named.
    pub(crate) name: String,
    /// Where it is.
    pub(crate) place: (f64, f64),
    /// How far around the place it reaches.
    pub(crate) radius: f64,
}

/// Where a name stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Spot {
    /// The end of the name that is nearer to its place, at half of its height.
    pub(crate) near: (f64, f64),
    /// Whether the name runs to the left from there, not to the right.
    pub(crate) at_left: bool,
    /// From the rim of the place to the name, where another name keeps it from being right beside.
    pub(crate) leader: Option<[(f64, f64); 2]>,
}

/// From the rim of a place to a name right beside it.
const GAP: f64 = 4.0;
/// How much farther away a name is that stands higher or lower than its place.
const SHIFT: f64 = 10.0;
/// From one line of names to the next.
const LINE: f64 = 13.0;
/// How large the names are written.
const FONT_SIZE: f64 = 11.0;

/// A spot in `frame` (width and height) for each of `labels`, in their order; the first ones have the first choice.
///
/// No two names overlap, and none leaves the frame. A name stands right beside its place while there is room, to the
/// right rather than to the left; else in the nearest line above or below, with a leader to its place. Only the first of
/// the names of one place is right beside it: the others would seem to be names of the same thing. Where all around a
/// large place there is no room, a name stands in it. A name for which there is no room anywhere has no spot.
///
/// # Complexity
///
/// O(n² h) for n labels in a frame h lines high.
pub(crate) fn spots(labels: &[Label], frame: (f64, f64)) -> Vec<Option<Spot>> {
    let mut taken: Vec<Extent> = Vec::new();
    let spot_of = |(index, label): (usize, &Label)| {
        let width = width(&label.name);
        let nearest = i32::from(labels[..index].iter().any(|first| first.is_where(label)));
        let around = candidates(label.place, label.radius, nearest, frame);
        let within = candidates(label.place, 0.0, nearest, frame);
        let mut with_extent = around.chain(within).map(|spot| (spot, Extent::of(&spot, width)));
        let is_free =
            |extent: &Extent| extent.is_within(frame) && !taken.iter().any(|other| other.overlaps(extent));
        let (spot, extent) = with_extent.find(|(_, extent)| is_free(extent))?;
        taken.push(extent);
        Some(spot)
    };
    labels.iter().enumerate().map(spot_of).collect()
}

impl Label {
    /// Whether both lie so much upon each other that only one of them is seen.
    fn is_where(&self, other: &Self) -> bool {
        let ((x, y), (other_x, other_y)) = (self.place, other.place);
        (x - other_x).hypot(y - other_y) < self.radius.min(other.radius)
    }
}

/// All spots beside a place that reaches `radius` around, the best one first: from the `nearest` line on, line by line
/// away from it.
fn candidates(
    place: (f64, f64),
    radius: f64,
    nearest: i32,
    (width, height): (f64, f64),
) -> impl Iterator<Item = Spot> {
    let lines = (height / LINE).ceil() as i32;
    let away = (nearest..=lines).flat_map(|line| if line == 0 { vec![0] } else { vec![-line, line] });
    // Where most of the room is at the left, all names of a place are better there.
    let sides = if place.0 > 0.72 * width { [true, false] } else { [false, true] };
    away.flat_map(move |line| sides.map(|at_left| spot(place, radius, line, at_left)))
}

fn spot((x, y): (f64, f64), radius: f64, line: i32, at_left: bool) -> Spot {
    let side = if at_left { -1.0 } else { 1.0 };
    if line == 0 {
        return Spot { near: (x + side * (radius + GAP), y), at_left, leader: None };
    }
    let (across, down) = (side * (radius + GAP + SHIFT), f64::from(line) * LINE);
    let distance = across.hypot(down);
    let rim = (x + across / distance * radius, y + down / distance * radius);
    let end = (x + across - side * 2.0, y + down);
    Spot { near: (x + across, y + down), at_left, leader: Some([rim, end]) }
}

/// How long a name is at most. Fonts differ; this is on the safe side for those of a screen.
fn width(name: &str) -> f64 {
    let share = |character: char| match character {
        'm' | 'w' | 'M' | 'W' => 1.0,
        'A'..='Z' => 0.8,
        ' '..='~' => 0.65,
        _ => 1.0,
    };
    FONT_SIZE * name.chars().map(share).sum::<f64>()
}

/// The part of the frame that a name covers.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Extent {
    left: f64,
    right: f64,
    middle: f64,
}

impl Extent {
    fn of(spot: &Spot, width: f64) -> Self {
        let (x, middle) = spot.near;
        let (left, right) = if spot.at_left { (x - width, x) } else { (x, x + width) };
        Self { left, right, middle }
    }

    fn overlaps(&self, other: &Self) -> bool {
        let apart = self.right <= other.left || other.right <= self.left;
        !apart && (self.middle - other.middle).abs() < LINE
    }

    fn is_within(&self, (width, height): (f64, f64)) -> bool {
        let half = LINE / 2.0;
        self.left >= 0.0 && self.right <= width && self.middle >= half && self.middle <= height - half
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRAME: (f64, f64) = (420.0, 300.0);

    fn label(name: &str, place: (f64, f64)) -> Label {
        Label { name: name.to_owned(), place, radius: 4.0 }
    }

    fn extents(labels: &[Label]) -> Vec<Extent> {
        let named = spots(labels, FRAME).into_iter().zip(labels);
        named.filter_map(|(spot, label)| Some(Extent::of(&spot?, width(&label.name)))).collect()
    }

    fn check_apart(labels: &[Label]) {
        let extents = extents(labels);
        for (index, extent) in extents.iter().enumerate() {
            assert!(extent.is_within(FRAME), "{extent:?}");
            assert!(!extents[..index].iter().any(|other| other.overlaps(extent)), "{extents:?}");
        }
    }

    #[test]
    fn a_name_alone_stands_right_beside_its_place() {
        let spot = Spot { near: (108.0, 50.0), at_left: false, leader: None };
        assert_eq!(spots(&[label("red", (100.0, 50.0))], FRAME), [Some(spot)]);
    }

    #[test]
    fn near_the_right_rim_a_name_stands_at_the_left() {
        let spot = Spot { near: (392.0, 50.0), at_left: true, leader: None };
        assert_eq!(spots(&[label("red", (400.0, 50.0))], FRAME), [Some(spot)]);
    }

    #[test]
    fn names_of_one_place_all_have_a_spot_and_leaders_tell_whose_they_are() {
        let labels = ["blue", "green", "yellow", "red"].map(|name| label(name, (380.0, 100.0)));
        check_apart(&labels);
        let spots: Vec<Spot> = spots(&labels, FRAME).into_iter().flatten().collect();
        assert_eq!(spots.len(), labels.len());
        for spot in &spots {
            let beside = spot.near.1.to_string() == "100";
            assert_eq!(spot.leader.is_none(), beside, "{spot:?}");
        }
    }

    #[test]
    fn a_leader_runs_from_the_rim_to_the_name() {
        let labels = ["a", "b", "c"].map(|name| label(name, (200.0, 150.0)));
        let led: Vec<Spot> =
            spots(&labels, FRAME).into_iter().flatten().filter(|it| it.leader.is_some()).collect();
        assert_eq!(led.len(), 2);
        let Some([(x, y), end]) = led[0].leader else { return };
        assert!(((x - 200.0).hypot(y - 150.0) - 4.0).abs() < 1e-9);
        assert_eq!(end, (led[0].near.0 - 2.0, led[0].near.1));
    }

    #[test]
    fn names_in_a_corner_stay_within_the_frame() {
        for place in [(2.0, 2.0), (418.0, 2.0), (2.0, 298.0), (418.0, 298.0)] {
            let labels: Vec<Label> = (0..6).map(|index| label(&format!("cube {index}"), place)).collect();
            assert_eq!(extents(&labels).len(), labels.len(), "{place:?}");
            check_apart(&labels);
        }
    }

    #[test]
    fn of_too_many_names_as_many_as_fit_have_a_spot() {
        let labels: Vec<Label> =
            (0..200).map(|index| label(&format!("thing {index}"), (210.0, 150.0))).collect();
        check_apart(&labels);
        let found = extents(&labels).len();
        assert!((40..200).contains(&found), "{found}");
    }

    #[test]
    fn a_place_that_fills_the_frame_has_its_name_in_it() {
        let all = Label { radius: 300.0, ..label("all", (210.0, 150.0)) };
        assert_eq!(spots(&[all], FRAME), [Some(Spot { near: (214.0, 150.0), at_left: false, leader: None })]);
    }

    #[test]
    fn a_name_longer_than_the_frame_has_no_spot() {
        assert_eq!(spots(&[label(&"long ".repeat(40), (10.0, 10.0))], FRAME), [None]);
    }
}
