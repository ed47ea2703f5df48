// One look into the map: shadows with the texels' own stairs.
float visibility(Receiver receiver) { return lit_at(receiver, receiver.texel); }
