//! Values of options by the names that people write.

use clap::ValueEnum;
use goalgraph::infer::RadiusRule;
use goalgraph::pdfa::Semantics;

/// Value of `--semantics`.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub(super) enum SemanticsName {
    /// A distribution over words: what was counted, with ending as one of the choices
    #[default]
    #[value(name = "maximum_likelihood", alias = "maximum-likelihood")]
    MaximumLikelihood,
    /// Equations 2 and 3 of the paper
    Published,
}

impl From<SemanticsName> for Semantics {
    fn from(name: SemanticsName) -> Self {
        match name {
            SemanticsName::MaximumLikelihood => Self::MaximumLikelihood,
            SemanticsName::Published => Self::Published,
        }
    }
}

/// Value of `--radius`.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub(super) enum Radius {
    /// What the bulk of the cluster's points needs
    #[default]
    Robust,
    /// The largest distance of a point to the center, as published
    Largest,
}

impl From<Radius> for RadiusRule {
    fn from(radius: Radius) -> Self {
        match radius {
            Radius::Robust => Self::Robust,
            Radius::Largest => Self::Largest,
        }
    }
}
