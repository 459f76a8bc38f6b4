//! What lanes of a certain processor have in common: a register of numbers, with the operations that are one instruction each.

/// Gives a number or a mask from instructions without memory.
macro_rules! numbers {
    ($instructions:expr) => {{
        // SAFETY: a value of such a type exists only where the processor has what its file asks for, and the
        // instructions read and write registers alone.
        #[allow(clippy::macro_metavars_in_unsafe, reason = "the macro is of this folder alone")]
        unsafe {
            $instructions
        }
    }};
}

/// Numbers in a register: how many, how they come from memory and go there, and the operations of two.
macro_rules! register {
    (
        $(#[$about:meta])*
        $name:ident($register:ident) of $count:literal,
        $zero:ident, $load:ident, $store:ident,
        $($trait:ident::$operation:ident is $instruction:ident),+
    ) => {
        $(#[$about])*
        #[derive(Clone, Copy)]
        struct $name($register);

        impl $name {
            #[inline(always)]
            fn to_array(self) -> [f64; $count] {
                let mut lanes = [0.0; $count];
                // SAFETY: as above; the array has as many numbers as the register.
                unsafe { $store(lanes.as_mut_ptr(), self.0) };
                lanes
            }

            #[inline(always)]
            fn from_array(lanes: &[f64; $count]) -> Self {
                // SAFETY: as above; the array has as many numbers as the register.
                unsafe { Self($load(lanes.as_ptr())) }
            }
        }

        impl Default for $name {
            #[inline(always)]
            fn default() -> Self {
                numbers!(Self($zero()))
            }
        }

        $(impl $trait for $name {
            type Output = Self;
            #[inline(always)]
            fn $operation(self, other: Self) -> Self {
                numbers!(Self($instruction(self.0, other.0)))
            }
        })+
    };
}

pub(super) use {numbers, register};
