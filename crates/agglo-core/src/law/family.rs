//! A family of laws as one list: one line for each law.

/// Makes the enum that a scenario fills, and all by which the rest of the program knows the family's laws.
///
/// `Law in file: "what it is";` stands for the law `file::Law` whose word is `file` and whose page is at the head of that file, in
/// the folder after `pages in`. The list also makes a macro with the name after `each by`, which does the same with whichever
/// law there is.
macro_rules! family {
    (@pages $($Law:ident in $file:ident)+) => {};
    (@pages $group:literal $($Law:ident in $file:ident)+) => {
        /// The pages of all laws of the family.
        pub const PAGES: &'static [$crate::pages::Page] = &[$($crate::pages::Page::new(
            stringify!($file),
            $group,
            <$file::$Law as $crate::law::Law>::WORDS,
            include_str!(concat!(stringify!($file), ".rs")),
        ),)+];
    };
    (
        $(#[$meta:meta])*
        pub enum $Family:ident at $key:literal, $(pages in $group:literal,)? each by $each:ident ($d:tt) {
            $($Law:ident in $file:ident: $says:tt;)+
        }
    ) => {
        $(pub use $file::$Law;)+

        $(#[$meta])*
        #[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
        #[serde(rename_all = "snake_case")]
        pub enum $Family {
            $(
                #[doc = $says]
                $Law($file::$Law),
            )+
        }

        #[allow(unused_macros, reason = "bonds have nothing that all of them do alike")]
        macro_rules! $each {
            ($d chosen:expr, $d law:ident => $d call:expr) => {
                match $d chosen {
                    $($Family::$Law($d law) => $d call,)+
                }
            };
        }

        impl $Family {
            /// All laws of the family.
            pub const LAWS: &'static [$crate::law::Entry] = &[$($crate::law::Entry {
                key: concat!($key, ".", stringify!($file)),
                reads: <$file::$Law as $crate::law::Law>::READS,
            },)+];

            family!(@pages $($group)? $($Law in $file)+);

            /// The law that is chosen.
            pub fn chosen(&self) -> $crate::law::Chosen<'_> {
                match self {
                    $(Self::$Law(law) => {
                        $crate::law::Chosen::new(concat!($key, ".", stringify!($file)), law)
                    })+
                }
            }
        }
    };
}

/// Says where a law stands that is the only one of its table; its word is the name of its file, and of its page if no other is given.
macro_rules! lone_law {
    ($Law:ident at $table:literal, $word:ident) => {
        lone_law!($Law at $table, $word, page $word);
    };
    ($Law:ident at $table:literal, $word:ident, page $page:ident) => {
        impl $Law {
            const KEY: &'static str = concat!($table, ".", stringify!($word));

            /// The law as it is listed among all.
            pub const ENTRY: $crate::law::Entry =
                $crate::law::Entry { key: Self::KEY, reads: <Self as $crate::law::Law>::READS };

            /// Its page.
            pub const PAGE: $crate::pages::Page = $crate::pages::Page::new(
                stringify!($page),
                $table,
                <Self as $crate::law::Law>::WORDS,
                include_str!(concat!(stringify!($word), ".rs")),
            );

            /// The law that is chosen.
            pub fn chosen(&self) -> $crate::law::Chosen<'_> {
                $crate::law::Chosen::new(Self::KEY, self)
            }
        }
    };
}
