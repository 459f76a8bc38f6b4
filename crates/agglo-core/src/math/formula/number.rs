//! What formulas do with numbers, and with numbers that have slopes.

use std::f64::consts::{LN_2, LN_10};

/// Makes the functions of one argument: value and slope of each.
macro_rules! unary {
    ($($Name:ident $word:literal: |$x:ident| $value:expr, $slope:expr;)+) => {
        /// A function of one argument.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub(super) enum Unary {
            $($Name,)+
        }

        impl Unary {
            /// The function with this name.
            pub fn named(word: &str) -> Option<Self> {
                match word {
                    $($word => Some(Self::$Name),)+
                    _ => None,
                }
            }

            fn value(self, x: f64) -> f64 {
                match self {
                    $(Self::$Name => { let $x = x; $value })+
                }
            }

            /// At a kink 0, or that of one side.
            #[allow(unused_variables, reason = "what is flat has the same slope everywhere")]
            fn slope(self, x: f64) -> f64 {
                match self {
                    $(Self::$Name => { let $x = x; $slope })+
                }
            }
        }
    };
}

unary! {
    Abs "abs": |x| x.abs(), if x == 0.0 { 0.0 } else { x.signum() };
    Acos "acos": |x| x.acos(), -1.0 / (1.0 - x * x).sqrt();
    Acosh "acosh": |x| x.acosh(), 1.0 / (x * x - 1.0).sqrt();
    Asin "asin": |x| x.asin(), 1.0 / (1.0 - x * x).sqrt();
    Asinh "asinh": |x| x.asinh(), 1.0 / (x * x + 1.0).sqrt();
    Atan "atan": |x| x.atan(), 1.0 / (1.0 + x * x);
    Atanh "atanh": |x| x.atanh(), 1.0 / (1.0 - x * x);
    Cbrt "cbrt": |x| x.cbrt(), 1.0 / (3.0 * x.cbrt() * x.cbrt());
    Ceil "ceil": |x| x.ceil(), 0.0;
    Cos "cos": |x| x.cos(), -x.sin();
    Cosh "cosh": |x| x.cosh(), x.sinh();
    Exp "exp": |x| x.exp(), x.exp();
    Floor "floor": |x| x.floor(), 0.0;
    Fract "fract": |x| x.fract(), 1.0 + 0.0;
    Ln "ln": |x| x.ln(), 1.0 / x;
    Log10 "log10": |x| x.log10(), 1.0 / (x * LN_10);
    Log2 "log2": |x| x.log2(), 1.0 / (x * LN_2);
    Round "round": |x| x.round(), 0.0;
    Signum "signum": |x| x.signum(), 0.0;
    Sin "sin": |x| x.sin(), x.cos();
    Sinh "sinh": |x| x.sinh(), x.cosh();
    Sqrt "sqrt": |x| x.sqrt(), 0.5 / x.sqrt();
    Tan "tan": |x| x.tan(), 1.0 + x.tan() * x.tan();
    Tanh "tanh": |x| x.tanh(), 1.0 - x.tanh() * x.tanh();
    Trunc "trunc": |x| x.trunc(), 0.0;
}

/// What takes two numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Binary {
    Plus,
    Minus,
    Times,
    Over,
    Power,
    Atan2,
    Max,
    Min,
}

impl Binary {
    /// The function with this name.
    pub fn named(word: &str) -> Option<Self> {
        match word {
            "atan2" => Some(Self::Atan2),
            "max" => Some(Self::Max),
            "min" => Some(Self::Min),
            _ => None,
        }
    }

    /// The operator with this sign.
    pub fn signed(sign: char) -> Option<Self> {
        match sign {
            '+' => Some(Self::Plus),
            '-' => Some(Self::Minus),
            '*' => Some(Self::Times),
            '/' => Some(Self::Over),
            '^' => Some(Self::Power),
            _ => None,
        }
    }

    pub fn value(self, a: f64, b: f64) -> f64 {
        match self {
            Self::Plus => a + b,
            Self::Minus => a - b,
            Self::Times => a * b,
            Self::Over => a / b,
            Self::Power => a.powf(b),
            Self::Atan2 => a.atan2(b),
            Self::Max => a.max(b),
            Self::Min => a.min(b),
        }
    }

    /// Slopes over the first and the second number.
    fn slopes(self, a: f64, b: f64) -> [f64; 2] {
        match self {
            Self::Plus => [1.0, 1.0],
            Self::Minus => [1.0, -1.0],
            Self::Times => [b, a],
            Self::Over => [1.0 / b, -a / (b * b)],
            Self::Power => [b * a.powf(b - 1.0), a.powf(b) * a.ln()],
            Self::Atan2 => {
                let square = a * a + b * b;
                [b / square, -a / square]
            }
            Self::Max => {
                if a >= b {
                    [1.0, 0.0]
                } else {
                    [0.0, 1.0]
                }
            }
            Self::Min => {
                if a <= b {
                    [1.0, 0.0]
                } else {
                    [0.0, 1.0]
                }
            }
        }
    }
}

/// What a formula can be worked out with.
pub(super) trait Number: Copy {
    fn of(constant: f64) -> Self;
    fn call(self, function: Unary) -> Self;
    fn join(self, operator: Binary, other: Self) -> Self;
}

impl Number for f64 {
    #[inline]
    fn of(constant: f64) -> Self {
        constant
    }

    #[inline]
    fn call(self, function: Unary) -> Self {
        function.value(self)
    }

    #[inline]
    fn join(self, operator: Binary, other: Self) -> Self {
        operator.value(self, other)
    }
}

/// A number that changes along some ways.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Dual<const N: usize> {
    pub value: f64,
    pub slopes: [f64; N],
}

/// What does not change adds nothing, however steep the function is.
#[inline]
fn chain(slope: f64, inner: f64) -> f64 {
    if inner == 0.0 { 0.0 } else { slope * inner }
}

impl<const N: usize> Number for Dual<N> {
    #[inline]
    fn of(constant: f64) -> Self {
        Self { value: constant, slopes: [0.0; N] }
    }

    #[inline]
    fn call(self, function: Unary) -> Self {
        let slope = function.slope(self.value);
        Self { value: function.value(self.value), slopes: self.slopes.map(|inner| chain(slope, inner)) }
    }

    #[inline]
    fn join(self, operator: Binary, other: Self) -> Self {
        let [first, second] = operator.slopes(self.value, other.value);
        Self {
            value: operator.value(self.value, other.value),
            slopes: std::array::from_fn(|way| {
                chain(first, self.slopes[way]) + chain(second, other.slopes[way])
            }),
        }
    }
}
