// No shadows: the floor of what a frame costs.
float visibility(Receiver receiver) { return 1; }
