//! How the automaton fits what was demonstrated, and how far it is from what was learned.

use leptos::prelude::*;

use crate::page::derived::Fit;
use crate::page::text::{measure, percent, significant};
use crate::page::update::App;
use crate::page::view::inspector::fact_with_help;

/// A few numbers that follow every edit.
pub(super) fn fit(app: App) -> impl IntoView {
    let accepted = move || {
        let Fit { accepted, demonstrations, .. } = app.derived.fit.get();
        format!("{accepted} of {demonstrations} ({})", percent(accepted, demonstrations))
    };
    let log_likelihood = move || {
        let fit = app.derived.fit.get();
        if fit.accepted == 0 { "none".to_owned() } else { significant(fit.log_likelihood) }
    };
    let divergence = move || app.derived.distance.with(|it| it.as_ref().map(|it| measure(it.kl_divergence)));
    let variation = move || {
        app.derived.distance.with(|it| {
            let bounds = &it.as_ref()?.total_variation;
            let (low, high) = (significant(bounds.low), significant(bounds.high));
            Some(if low == high { low } else { format!("{low} to {high}") })
        })
    };
    let lacking = move || {
        let Fit { accepted, demonstrations, .. } = app.derived.fit.get();
        accepted < demonstrations
    };
    view! {
        <dl class="facts fit" class:lacking=lacking>
            {fact_with_help("Accepted", "Demonstrations whose word the automaton accepts.", accepted)}
            {fact_with_help("Log-likelihood", "Natural logarithm of the probability of all accepted demonstrations.", log_likelihood)}
            {fact_with_help("KL divergence", "From the words as learned to the words as they are now, in nats: infinite once a learned word is gone.", divergence)}
            {fact_with_help("Total variation", "Half the sum of all differences in the probability of words, between what was learned and what is now: from 0 to 1.", variation)}
        </dl>
    }
}
