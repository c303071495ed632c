#version 460
#extension GL_GOOGLE_include_directive : require
#include "test/library/harness.glsl"
#include "lib/lobe.glsl"

void put(LobeMoments m) { put(m.mean); put(m.deficit); }
void put(SgLobe l) { put(l.axis); put(l.sharpness); }
LobeMoments take_moments() { vec3 mean = take3(); return LobeMoments(mean, take()); }

void call() {
  switch (FUNCTION) {
    case 0u: put(lobe_one_minus_length(take())); break;
    case 1u: put(lobe_encode(take3(), take())); break;
    case 2u: put(lobe_sharpness(take(), take())); break;
    case 3u: put(lobe_decode(take_moments())); break;
    case 4u: put(toksvig_encode(take3(), take())); break;
    case 5u: put(toksvig_decode(take_moments())); break;
    case 6u: put(laurijssen_encode(take3(), take())); break;
    case 7u: put(laurijssen_decode(take_moments())); break;
    case 8u: { uint kind = take_uint(); put(lobe_encode_by(kind, take3(), take())); break; }
    case 9u: { uint kind = take_uint(); put(lobe_decode_by(kind, take_moments())); break; }
  }
}
