// The loop of all shading kernels. Several pixels an invocation share the load of each light; the lights lie in a uniform block.

void main() {
  uint first = gl_WorkGroupID.x * (SHADING_GROUP * PIXELS) + gl_LocalInvocationID.x;
  Receiver receivers[PIXELS];
  Sums sums[PIXELS];
  [[unroll]] for (uint j = 0; j < PIXELS; ++j) {
    uint place = min(first + j * SHADING_GROUP, push.receivers - 1);
    receivers[j] = make_receiver(place, surfaces[place], push.camera);
    sums[j] = Sums(vec3(0.0), vec3(0.0), 0.0);
  }
  for (uint i = 0; i < push.lights; ++i) {
    SHADING_LIGHT light = lights[i];
    [[unroll]] for (uint j = 0; j < PIXELS; ++j) add_light(receivers[j], light, sums[j]);
  }
  [[unroll]] for (uint j = 0; j < PIXELS; ++j) {
    uint k = first + j * SHADING_GROUP;
    if (k >= push.receivers) continue;
    results[k].diffuse += sums[j].diffuse;
    results[k].specular += sums[j].specular;
    results[k].aside += sums[j].aside;
  }
}
