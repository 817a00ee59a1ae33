// What a known change of light leaves of a history (FDenoiseInputs::ChangedShare).
#ifndef LANTERN_DENOISE_CHANGED_SHARE_GLSL
#define LANTERN_DENOISE_CHANGED_SHARE_GLSL

// Returns the standard deviation of what has changed. Changed: share of the light, and radiance. Brightness: of the signal.
float GetChangeError(vec2 Changed, float Brightness)
{
	float Error = Changed.x * Brightness + Changed.y;
	return Error > 0.0 && !isinf(Error) ? Error : 0.0;
}

// Returns the share of its frames that a history is still worth.
float GetKeptShare(float Error, float Brightness) { return 1.0 - min(Error / max(Brightness, 1.0e-20), 1.0); }

#endif
