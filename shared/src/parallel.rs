//! Work that is split over threads, where the caller has some.
//!
//! The engine starts no thread: with the feature `parallel` it hands work to the pool of rayon that it is called in.
//! Without it, as in the browser, everything is done in order. The results are the same.

/// How many pieces of work are worth handing over at once: all of them where there are threads, one after the other where
/// there are none, so that somebody who waits can be told what is being done.
pub(crate) const AT_ONCE: usize = if cfg!(feature = "parallel") { usize::MAX } else { 1 };

/// Does `work` on each of `items`.
#[cfg(feature = "parallel")]
pub(crate) fn each<T: Send>(items: &mut [T], work: impl Fn(&mut T) + Sync + Send) {
    use rayon::prelude::*;
    items.par_iter_mut().for_each(work);
}

/// Does `work` on each of `items`.
#[cfg(not(feature = "parallel"))]
pub(crate) fn each<T>(items: &mut [T], work: impl Fn(&mut T)) {
    items.iter_mut().for_each(work);
}

/// The results of `work` for the numbers from 0 to `count`, in their order.
#[cfg(feature = "parallel")]
pub(crate) fn map<T: Send>(count: usize, work: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
    use rayon::prelude::*;
    (0..count).into_par_iter().map(work).collect()
}

/// The results of `work` for the numbers from 0 to `count`, in their order.
#[cfg(not(feature = "parallel"))]
pub(crate) fn map<T>(count: usize, work: impl Fn(usize) -> T) -> Vec<T> {
    (0..count).map(work).collect()
}

/// The results of two pieces of work.
#[cfg(feature = "parallel")]
pub(crate) fn both<A: Send, B: Send>(
    first: impl FnOnce() -> A + Send,
    second: impl FnOnce() -> B + Send,
) -> (A, B) {
    rayon::join(first, second)
}

/// The results of two pieces of work.
#[cfg(not(feature = "parallel"))]
pub(crate) fn both<A, B>(first: impl FnOnce() -> A, second: impl FnOnce() -> B) -> (A, B) {
    (first(), second())
}
