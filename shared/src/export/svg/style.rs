//! Colors and typefaces of the exported drawing.

/// Backgrounds of chips; dark text on each has a contrast of 7 to 1 or more.
pub(super) const CHIP_COLORS: [&str; 10] = [
    "#fbd5d0", "#fdebb0", "#cfe3fb", "#d3efd2", "#e6dafa", "#fcdcbd", "#c9eeee", "#f9d3e6", "#e4e6ea",
    "#e3edb4",
];

/// Style sheet, without characters that XML escapes.
pub(super) const STYLE: &str = "
text{font-family:system-ui,-apple-system,'Segoe UI',Roboto,Helvetica,Arial,sans-serif;text-anchor:middle;dominant-baseline:central}
.page{fill:#ffffff}
.shaft{fill:none;stroke:#6b7684}
.head{fill:#6b7684}
.box{fill:#ffffff;stroke:#2f3a47;stroke-width:1.25}
.chip{stroke:#1f2933;stroke-opacity:.14}
.name{font-size:12px;fill:#1f2933}
.note{font-size:12px;fill:#52606d}
.id,.evidence{font-size:11px;fill:#52606d}
.ground{fill:#ffffff;fill-opacity:.88}
";
