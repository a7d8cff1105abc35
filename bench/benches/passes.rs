//! Single passes of the engine, for work on one of them: `cargo bench -p goalgraph-bench`.

use divan::Bencher;
use divan::counter::{BytesCount, ItemsCount};
use goalgraph::dbscan::dbscan;
use goalgraph::pdfa::Pdfa;
use goalgraph_bench::clouds::Cloud;
use goalgraph_bench::recordings::{one_file, read};
use goalgraph_bench::words::words;

fn main() {
    divan::main();
}

#[divan::bench(args = ["rests", "scattered-rests", "uniform", "blobs"])]
fn clustering(bencher: Bencher, name: &str) {
    const POINTS: usize = 100_000;
    let Some(cloud) = Cloud::named(name) else { return };
    let (points, parameters) = (cloud.points(POINTS, 3), cloud.parameters(POINTS, 3));
    bencher.counter(ItemsCount::new(POINTS)).bench_local(|| dbscan(&points, parameters));
}

#[divan::bench]
fn reading(bencher: Bencher) {
    let file = one_file(1);
    bencher.counter(BytesCount::new(file.text.len())).bench_local(|| read(&file));
}

#[divan::bench]
fn words_to_automaton(bencher: Bencher) {
    const SYMBOLS: usize = 120_000;
    let words = words(SYMBOLS);
    bencher.counter(ItemsCount::new(SYMBOLS)).bench_local(|| Pdfa::from_words(&words));
}
