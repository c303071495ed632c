#version 460
#extension GL_GOOGLE_include_directive : require
#include "test/library/harness.glsl"
#include "test/stability/published.glsl"

// The forms before, with the arguments of the library functions that stand for them (tests/stability/hazards_test.cpp).
SpecularReceiver take_receiver() {
  uint ndf = take_uint();
  float alpha = take();
  vec3 normal = take3();
  return specular_receiver(ndf, alpha, normal, take3());
}

void put_ggx() { float alpha2 = take(), sin2 = take(); put(published_ggx_d(alpha2, take())); }
void put_phong() { float alpha2 = take(), sin2 = take(); put(published_phong_d(alpha2, take())); }

// Four taps of (weight, position, second moment), as a mip step averages them; the total variance of the last.
void put_raw_moments() {
  float weight = 0.0, second = 0.0;
  vec3 first = vec3(0.0);
  for (int i = 0; i < 4; ++i) {
    float w = take();
    weight += 0.25 * w;
    first += 0.25 * w * take3();
    second += 0.25 * w * take();
  }
  vec3 mean = first / weight;
  put(weight);
  put(mean);
  put(second / weight);
  put(second / weight - dot(mean, mean));
}

void call() {
  switch (FUNCTION) {
    case 0u: put_ggx(); break;
    case 1u: put_phong(); break;
    case 2u: put(published_sg(take3(), take3(), take())); break;
    case 3u: put(factored_sg(take3(), take3(), take())); break;
    case 4u: put(published_sg_integral(take())); break;
    case 5u: put(published_product(take3(), take(), take3(), take())); break;
    case 6u: put(published_solid_angle(take(), take())); break;
    case 7u: put(published_sharpness(take3())); break;
    case 8u: put(published_fluence(take3(), take(), take3(), take())); break;
    case 9u: put(published_kernel_level(take(), take(), take())); break;
    case 10u: {
      SpecularReceiver r = take_receiver();
      SpecularFilter f = published_filter(r, specular_local(r, take3()), take());
      put(f.density);
      put(f.slope_cosine);
      break;
    }
    case 11u: put(published_asg_exponent(take3(), take2(), take())); break;
    case 12u: put(published_cosine_mean(take(), take())); break;
    case 13u: put_raw_moments(); break;
  }
}
