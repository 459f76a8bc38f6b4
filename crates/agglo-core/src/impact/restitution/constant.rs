//! Constant restitution: one e for all impacts.
//!
//! # Equation
//! ```text
//! v' = e v,   J_n = m* (1 + e) v,   loss = (1 - e²) m* v²/2                             [B] 2.1-2.5
//! ```
//!
//! # Source
//! [B] T. I. Zohdi, Proc. R. Soc. Lond. A 460, 3421 (2004), section 2.
//!
//! # Symbols
//! | symbol | name in code     | unit | meaning                                                    |
//! |--------|------------------|------|------------------------------------------------------------|
//! | e      | `restitution`    | -    | from 0 to 1; at 0 pairs stick                              |
//! | v, v'  | `approach`       | m/s  | relative speed along the normal, before and after          |
//! | J_n    | `normal_impulse` | N s  |                                                            |
//! | m*     | `reduced_mass`   | kg   | m_i m_j/(m_i + m_j)                                        |
//!
//! # Valid when
//! Restitution falls with speed in all real materials; a constant is the standard model of granular gases. With the contact
//! area of the default ends, a0 = 0 and af = 1, reactive materials heat up as with `hardness`.
//!
//! # Compared with others
//! The model of Haff (1983) and of most event-driven programs.
//!
//! # In a scenario
//! ```toml
//! [impact.restitution.constant]
//! restitution = 0.9
//! ```
//!
//! # Example
//! ```
//! # extern crate agglo_core as agglo;
//! use agglo::impact::restitution::Constant;
//! let law: Constant = serde_json::from_str(r#"{"restitution": 0.9}"#).unwrap();
//! assert_eq!(law.restitution, 0.9);
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Rebound, RestitutionLaw};
use crate::law::{Context, Faults, Law};

/// One restitution for all impacts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Constant {
    /// e of all impacts, from 0 to 1; at 0 pairs stick.
    pub restitution: f64,
}

impl Law for Constant {
    fn faults(&self, faults: &mut Faults, _: &Context<'_>) {
        if self.restitution > 1.0 {
            let message = format!("found {}; a number from 0 to 1 is wanted", self.restitution);
            faults.fail_with("restitution", message, "an impact with more than 1 would create energy");
        } else {
            faults.within("restitution", self.restitution, 0.0, 1.0);
        }
    }
}

impl RestitutionLaw for Constant {
    fn rebound(&self) -> Rebound {
        Rebound::Constant(self.restitution)
    }
}
