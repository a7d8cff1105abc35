//! Work that is split over threads, where the caller has some.
//!
//! The engine starts no thread: with the feature `parallel` it hands work to the pool of rayon that it is called in.
//! Without it, as in the browser, everything is done in order. The results are the same.

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
