fn main() { let library = shagreen_formats::starter::starter_library().unwrap(); shagreen_app::run(shagreen_app::Start { library, output: Some("null".into()) }).unwrap(); }
