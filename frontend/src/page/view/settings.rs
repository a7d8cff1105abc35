//! How the inference searches: subsets, their parameters, method.

use goalgraph::infer::{Method, RadiusRule};
use goalgraph::pdfa::Semantics;
use goalgraph::subset::{Setting, SubsetRequest};
use leptos::prelude::*;

use super::chips::button;
use crate::page::model::Notice;
use crate::page::update::{Action, App};

/// The column at the right of the Demonstrations tab.
pub(crate) fn settings(app: App) -> impl IntoView {
    let count = Memo::new(move |_| app.derived.subsets.with(Vec::len));
    let chosen = move || app.model.settings.with(|settings| settings.subsets.is_some());
    view! {
        <aside class="inspector" aria-label="Settings">
            <header class="section-head"><h2>"Feature subsets"</h2> {button(app, "infer")}</header>
            <p class="hint">"Sub-goals are searched in each subset separately, one per object as a rule."</p>
            <ul class="subset-editors">
                <For each=move || 0..count.get() key=|index| *index children=move |index| subset_editor(app, index) />
            </ul>
            <div class="row">
                <button type="button" class="button" on:click=move |_| add_subset(app)>"Add subset"</button>
                <button type="button" class="button" disabled=move || !chosen() on:click=move |_| app.act(Action::ChooseSubsets(None))>
                    "Reset to proposal"
                </button>
            </div>
            <h3>"Method"</h3>
            {method(app)}
        </aside>
    }
}

fn method(app: App) -> impl IntoView {
    let settings = app.model.settings;
    view! {
        {choice(
            "Frames",
            [("at-rest", "Where things come to rest"), ("published", "Every frame, as published")],
            move || if settings.get().method == Method::Published { "published" } else { "at-rest" },
            move |value| app.act(Action::ChooseMethod(if value == "published" { Method::Published } else { Method::AtRest })),
        )}
        {choice(
            "Radius",
            [("robust", "Robust"), ("largest", "Largest distance, as published")],
            move || if settings.get().radius == RadiusRule::Largest { "largest" } else { "robust" },
            move |value| app.act(Action::ChooseRadius(if value == "largest" { RadiusRule::Largest } else { RadiusRule::Robust })),
        )}
        {choice(
            "Probabilities",
            [("ml", "Maximum likelihood"), ("published", "As published")],
            move || if app.derived.semantics.get() == Semantics::Published { "published" } else { "ml" },
            move |value| {
                let published = value == "published";
                app.act(Action::ChooseSemantics(if published { Semantics::Published } else { Semantics::MaximumLikelihood }));
            },
        )}
    }
}

/// A choice among a few named values.
fn choice(
    label: &'static str,
    options: [(&'static str, &'static str); 2],
    chosen: impl Fn() -> &'static str + Copy + Send + Sync + 'static,
    choose: impl Fn(String) + 'static,
) -> impl IntoView {
    let option = move |(value, name): (&'static str, &'static str)| {
        view! { <option value=value selected=move || chosen() == value>{name}</option> }
    };
    view! {
        <label class="field">
            <span>{label}</span>
            <select prop:value=chosen on:change=move |event| choose(event_target_value(&event))>
                {options.map(option).collect_view()}
            </select>
        </label>
    }
}

fn subset_editor(app: App, index: usize) -> impl IntoView {
    let subset = Memo::new(move |_| {
        app.derived.subsets.with(|subsets| subsets.get(index).cloned()).unwrap_or_default()
    });
    let with = move |change: fn(&mut SubsetRequest, &str) -> Result<(), String>| {
        move |event: web_sys::Event| {
            let mut subsets = app.derived.subsets.get_untracked();
            let Some(subset) = subsets.get_mut(index) else { return };
            match change(subset, event_target_value(&event).trim()) {
                Ok(()) => app.act(Action::ChooseSubsets(Some(subsets))),
                Err(reason) => app.act(Action::Say(Notice::alarm(reason))),
            }
        }
    };
    view! {
        <li class="subset-editor">
            <div class="subset-head">
                <input
                    class="subset-name"
                    aria-label=move || format!("Name of subset {}", index + 1)
                    prop:value=move || subset.get().name
                    on:change=with(set_name)
                />
                <button
                    type="button"
                    class="icon-button small"
                    aria-label=move || format!("Remove subset {}", subset.get().name)
                    on:click=move |_| remove_subset(app, index)
                >
                    <span aria-hidden="true">"×"</span>
                </button>
            </div>
            <label class="field wide">
                <span>"Features"</span>
                <input spellcheck="false" prop:value=move || subset.get().features.join(" ") on:change=with(set_features) />
            </label>
            <div class="field-pair">
                <label class="field">
                    <span>"epsilon"</span>
                    <input prop:value=move || written(subset.get().epsilon) on:change=with(set_epsilon) />
                </label>
                <label class="field">
                    <span>"min. points"</span>
                    <input prop:value=move || written(subset.get().min_points) on:change=with(set_min_points) />
                </label>
            </div>
        </li>
    }
}

fn written<T: ToString>(setting: Setting<T>) -> String {
    match setting {
        Setting::Auto => "auto".to_owned(),
        Setting::Fixed(value) => value.to_string(),
    }
}

fn set_name(subset: &mut SubsetRequest, text: &str) -> Result<(), String> {
    if text.is_empty() {
        return Err("A subset needs a name.".to_owned());
    }
    text.clone_into(&mut subset.name);
    Ok(())
}

fn set_features(subset: &mut SubsetRequest, text: &str) -> Result<(), String> {
    let names = text.split([' ', ',', ';']).filter(|name| !name.is_empty());
    subset.features = names.map(str::to_owned).collect();
    if subset.features.is_empty() { Err("A subset needs at least one feature.".to_owned()) } else { Ok(()) }
}

/// Takes what was typed for epsilon.
pub(super) fn set_epsilon(subset: &mut SubsetRequest, text: &str) -> Result<(), String> {
    let positive = |value: &f64| value.is_finite() && *value > 0.0;
    subset.epsilon =
        parsed(text, positive).ok_or("epsilon is auto or a number above 0, in the unit of the features.")?;
    Ok(())
}

/// Takes what was typed for min. points.
pub(super) fn set_min_points(subset: &mut SubsetRequest, text: &str) -> Result<(), String> {
    subset.min_points =
        parsed(text, |&value: &usize| value > 0).ok_or("min. points is auto or a whole number from 1.")?;
    Ok(())
}

/// `auto`, nothing, or a number that is allowed.
fn parsed<T: std::str::FromStr>(text: &str, allowed: impl Fn(&T) -> bool) -> Option<Setting<T>> {
    if text.is_empty() || text.eq_ignore_ascii_case("auto") {
        return Some(Setting::Auto);
    }
    text.parse().ok().filter(allowed).map(Setting::Fixed)
}

fn add_subset(app: App) {
    let mut subsets = app.derived.subsets.get_untracked();
    let features = app.derived.accepted.with_untracked(|accepted| {
        accepted.first().map(|(_, content)| content.features.iter().map(|it| it.name.clone()).collect())
    });
    let name = format!("subset {}", subsets.len() + 1);
    subsets.push(SubsetRequest { name, features: features.unwrap_or_default(), ..SubsetRequest::default() });
    app.act(Action::ChooseSubsets(Some(subsets)));
}

fn remove_subset(app: App, index: usize) {
    let mut subsets = app.derived.subsets.get_untracked();
    subsets.remove(index);
    app.act(Action::ChooseSubsets((!subsets.is_empty()).then_some(subsets)));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameters_are_auto_or_numbers_that_make_sense() {
        let mut subset = SubsetRequest::default();
        assert!(set_epsilon(&mut subset, "0.02").is_ok());
        assert_eq!(subset.epsilon, Setting::Fixed(0.02));
        assert!(set_epsilon(&mut subset, "auto").is_ok());
        assert_eq!(subset.epsilon, Setting::Auto);
        assert!(set_epsilon(&mut subset, "-1").is_err());
        assert!(set_min_points(&mut subset, "2.5").is_err());
    }

    #[test]
    fn features_are_told_apart_by_blanks_or_commas() {
        let mut subset = SubsetRequest::default();
        assert!(set_features(&mut subset, "red.x, red.y red.z").is_ok());
        assert_eq!(subset.features, ["red.x", "red.y", "red.z"]);
        assert!(set_features(&mut subset, " , ").is_err());
    }
}
