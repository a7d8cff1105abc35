//! Times as people read them, by the clock of the place where they sit.

use js_sys::Date;
use wasm_bindgen::JsValue;

/// The time of day of a time in RFC 3339, with the day when that is not today; as it is written when it is no time.
pub(crate) fn of(time: &str) -> String {
    let date = Date::new(&JsValue::from_str(time));
    if date.get_time().is_nan() { time.to_owned() } else { shown(&date) }
}

/// The time of day of a time in milliseconds since 1970, with the day when that is not today.
pub(crate) fn of_ms(ms: f64) -> String {
    shown(&Date::new(&JsValue::from_f64(ms)))
}

fn shown(date: &Date) -> String {
    let time = format!("{:02}:{:02}:{:02}", date.get_hours(), date.get_minutes(), date.get_seconds());
    if day(date) == day(&Date::new_0()) {
        return time;
    }
    let (year, month, day) = day(date);
    format!("{year}-{month:02}-{day:02} {time}")
}

fn day(date: &Date) -> (u32, u32, u32) {
    (date.get_full_year(), date.get_month() + 1, date.get_date())
}
