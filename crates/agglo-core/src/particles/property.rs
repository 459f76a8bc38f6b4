//! The properties of materials by name, so that laws can say which they read.

use super::Material;

/// A property that a material may have or not; density is none of these, since every material has one.
#[derive(Clone, Copy)]
pub struct Property {
    /// Its key in a scenario.
    pub key: &'static str,
    /// A value as a scenario writes it, with its unit.
    pub example: &'static str,
    is_given: fn(&Material) -> bool,
}

impl Property {
    /// Whether a material has it.
    pub fn is_given(&self, material: &Material) -> bool {
        (self.is_given)(material)
    }
}

impl std::fmt::Debug for Property {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(self.key)
    }
}

impl PartialEq for Property {
    fn eq(&self, other: &Self) -> bool {
        self.key == other.key
    }
}

macro_rules! properties {
    ($($name:ident $key:ident $example:literal;)+) => {
        $(
            #[doc = concat!("`", stringify!($key), "`, such as ", $example, ".")]
            pub const $name: Property = Property {
                key: stringify!($key),
                example: $example,
                is_given: |material| material.$key.is_some(),
            };
        )+

        /// All of them, in the order of [`Material`].
        pub const PROPERTIES: &[Property] = &[$($name),+];
    };
}

properties! {
    SOUND_SPEED sound_speed "\"4500 m/s\"";
    SHEAR_SOUND_SPEED shear_sound_speed "\"2700 m/s\"";
    YOUNGS_MODULUS youngs_modulus "\"70 GPa\"";
    POISSON_RATIO poisson_ratio "0.25";
    CONTACT_STIFFNESS contact_stiffness "\"10 MPa\"";
    SOFTENING softening "{ reference_temperature = \"500 K\", sensitivity = 1, lowest_stiffness = \"1 MPa\" }";
    HEAT_CAPACITY heat_capacity "\"1000 J/(kg K)\"";
    HARDNESS hardness "\"1 MPa\"";
    ACTIVATION_ENERGY activation_energy "\"20 kJ\"";
    REACTION_HEAT reaction_heat "\"1 kJ/m2\"";
    SURFACE_ENERGY surface_energy "\"1 J/m2\"";
    EMISSIVITY emissivity "0.9";
    THERMAL_CONDUCTIVITY thermal_conductivity "\"1 W/(m K)\"";
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every field of a material but its density is a property, in the same order.
    #[test]
    fn they_are_the_fields_of_a_material() {
        let schema = serde_json::to_value(schemars::schema_for!(Material)).unwrap();
        let mut fields: Vec<&str> =
            schema["properties"].as_object().unwrap().keys().map(String::as_str).collect();
        fields.retain(|key| *key != "density");
        let mut told: Vec<&str> = PROPERTIES.iter().map(|property| property.key).collect();
        fields.sort_unstable();
        told.sort_unstable();
        assert_eq!(told, fields, "properties and fields");
    }

    /// Each is seen where it is given, with its own example, and nowhere else.
    #[test]
    fn each_is_seen_where_it_is_given() {
        for property in PROPERTIES {
            let mut text = property.example.replace(" = ", ": ");
            for key in ["reference_temperature", "sensitivity", "lowest_stiffness"] {
                text = text.replace(key, &format!("\"{key}\""));
            }
            let material = format!(r#"{{"density": "1000 kg/m3", "{}": {text}}}"#, property.key);
            let material: Material = serde_json::from_str(&material).unwrap();
            let given: Vec<&Property> = PROPERTIES.iter().filter(|other| other.is_given(&material)).collect();
            assert_eq!(given, [property], "properties given");
        }
    }
}
