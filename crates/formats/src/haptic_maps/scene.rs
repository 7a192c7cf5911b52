//! Scene of maps: a square with a haptic material, in glTF 2.0.

use serde_json::{Value, json};

use crate::haptic_maps::check::EXTENSION;
use crate::haptic_maps::sidecar::{FrictionMapV1, HeightMapV1, MapsV1};
use crate::haptic_maps::uri::uri_of;
use crate::layout;

/// Numbers of glTF for types, filters and uses of a buffer.
const FLOAT: u32 = 5126;
const UNSIGNED_SHORT: u32 = 5123;
const LINEAR: u32 = 9729;
const REPEAT: u32 = 10_497;
const ARRAY_BUFFER: u32 = 34_962;
const ELEMENT_ARRAY_BUFFER: u32 = 34_963;

/// Corners of the square in its plane, counterclockwise.
const CORNERS: [[f32; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
/// Corners of its two triangles.
const TRIANGLES: [u16; 6] = [0, 1, 2, 0, 2, 3];
/// Nesting up to which objects have a line for each field.
const OPEN_DEPTH: usize = 3;
/// What readers of the standard cannot know.
const NOT_STANDARD: &str = "the meaning of texels: MPEG_haptic_material does not define it; black, white and units are of this program";

/// Returns the scene and the vertices to which it refers.
///
/// The square has a side of 1, and its node scales it to meters. The first row of a picture lies at its upper edge, the side of
/// positive y, as texture coordinates of glTF count rows from the top.
pub(super) fn scene(maps: &MapsV1) -> [Vec<u8>; 2] {
    let positions = floats(CORNERS.iter().flat_map(|[x, y]| [*x, *y, 0.0]));
    let normals = floats(CORNERS.iter().flat_map(|_| [0.0, 0.0, 1.0]));
    let coordinates = floats(CORNERS.iter().flat_map(|[x, y]| [*x, 1.0 - *y]));
    let triangles = TRIANGLES.into_iter().flat_map(u16::to_le_bytes).collect();
    let parts = [
        (positions, ARRAY_BUFFER),
        (normals, ARRAY_BUFFER),
        (coordinates, ARRAY_BUFFER),
        (triangles, ELEMENT_ARRAY_BUFFER),
    ];
    let mut offset = 0;
    let view = |(part, target): &(Vec<u8>, u32)| {
        let view = json!({"buffer": 0, "byteOffset": offset, "byteLength": part.len(), "target": target});
        offset += part.len();
        view
    };
    let views: Vec<Value> = parts.iter().map(view).collect();
    let bin: Vec<u8> = parts.into_iter().flat_map(|(part, _)| part).collect();
    let gltf = json!({
        "asset": {"version": "2.0", "generator": maps.created_by, "copyright": maps.license},
        "extensionsUsed": [EXTENSION],
        "extensions": {EXTENSION: {"materials": [haptic_material(maps)]}},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [node(maps)],
        "meshes": [mesh(maps)],
        "materials": [material(maps)],
        "textures": textures(maps),
        "images": images(maps),
        "samplers": [{"magFilter": LINEAR, "minFilter": LINEAR, "wrapS": REPEAT, "wrapT": REPEAT}],
        "accessors": accessors(),
        "bufferViews": views,
        "buffers": [{"uri": uri_of(&maps.vertices), "byteLength": bin.len()}],
    });
    [layout::to_bytes(&gltf, OPEN_DEPTH), bin]
}

fn floats(values: impl Iterator<Item = f32>) -> Vec<u8> {
    values.flat_map(f32::to_le_bytes).collect()
}

fn node(maps: &MapsV1) -> Value {
    let side_m = 1e-3 * maps.height.side_mm;
    json!({"name": maps.name, "mesh": 0, "scale": [side_m, side_m, 1.0]})
}

fn mesh(maps: &MapsV1) -> Value {
    let attributes = json!({"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2});
    json!({
        "name": maps.name,
        "primitives": [{"attributes": attributes, "indices": 3, "material": 0}],
        "extensions": {EXTENSION: {"hapticMaterialIndex": 0}},
    })
}

/// The visible material: plain gray, because maps are no picture of the surface.
fn material(maps: &MapsV1) -> Value {
    json!({"name": maps.name, "pbrMetallicRoughness": {"metallicFactor": 0.0, "roughnessFactor": 1.0}})
}

fn haptic_material(maps: &MapsV1) -> Value {
    let mut material = json!({
        "name": maps.name,
        "vibrotactileTexture": [height_texture(&maps.height)],
        "extras": {"not_standard": NOT_STANDARD},
    });
    if let Some(friction) = &maps.friction {
        material["friction"] = json!([friction_texture(friction)]);
    }
    if let Some(stiffness_n_per_m) = maps.stiffness_n_per_m {
        material["extras"]["stiffness_n_per_m"] = json!(stiffness_n_per_m);
    }
    material
}

fn height_texture(height: &HeightMapV1) -> Value {
    let extras = json!({
        "black_um": height.black_um,
        "white_um": height.white_um,
        "mm_per_pixel": height.mm_per_pixel,
        "tiles": height.tiles,
        "source": height.source,
    });
    json!({"texture": {"index": 0}, "type": "High_Resolution", "extras": extras})
}

fn friction_texture(friction: &FrictionMapV1) -> Value {
    let extras =
        json!({"black": friction.black, "white": friction.white, "coefficient": friction.coefficient});
    json!({"texture": {"index": 1}, "type": "Low_Resolution", "extras": extras})
}

fn pictures(maps: &MapsV1) -> impl Iterator<Item = &str> {
    let friction = maps.friction.as_ref().map(|friction| friction.picture.as_str());
    std::iter::once(maps.height.picture.as_str()).chain(friction)
}

fn textures(maps: &MapsV1) -> Value {
    pictures(maps).enumerate().map(|(index, _)| json!({"source": index, "sampler": 0})).collect()
}

fn images(maps: &MapsV1) -> Value {
    pictures(maps).map(|picture| json!({"uri": uri_of(picture), "mimeType": "image/png"})).collect()
}

fn accessors() -> Value {
    let n = CORNERS.len();
    json!([
        {
            "bufferView": 0, "componentType": FLOAT, "count": n, "type": "VEC3",
            "min": [0.0, 0.0, 0.0], "max": [1.0, 1.0, 0.0],
        },
        {"bufferView": 1, "componentType": FLOAT, "count": n, "type": "VEC3"},
        {"bufferView": 2, "componentType": FLOAT, "count": n, "type": "VEC2"},
        {"bufferView": 3, "componentType": UNSIGNED_SHORT, "count": TRIANGLES.len(), "type": "SCALAR"},
    ])
}
