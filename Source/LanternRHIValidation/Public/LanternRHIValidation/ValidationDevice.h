// Wraps any device and catches wrong use of the RHI: each fault is one message that names the object and the rule,
// and the call is dropped or returns InvalidArgument, so it never reaches the wrapped device. Errors of the
// environment (no memory, too large for the device, device lost) pass through without a message.
//
// Resource states are followed from submission to submission, in submission order:
// - Textures: a barrier's Before must be the state the texture is in, or None (contents lost); a use needs a state that
//   includes its access. An imported texture's state is taken from its first barrier.
// - Device and Readback buffers: as textures, but one that nothing has used yet may be in any state, two read-only uses
//   in a row need no barrier, and HostRead ends where the CPU waited: any use may follow it. A memory barrier
//   moves every buffer that is in its Before to its After.
// - Upload buffers: the CPU's writes are visible to every submission; reads need no barrier.
// - Scenes: an instance in an Upload buffer that points at a released geometry, or at one that no list builds, is named and
//   BuildScene is dropped; what only the submission can tell (instances written later) refuses the submission.
// - Shader tables: calls that exclude each other are told where they meet; after SetPipeline, what rays can reach must have
//   been set again: every ray generation, miss and callable record that was ever set, and the first hit record of each
//   instance. Where the instances are not known, only that not one hit record was set again is certain to be wrong.
// - Uses by shaders through addresses and bindless indices are not seen, the barriers around them are.
#pragma once

#include "LanternRHI/RTInterfaces.h"

namespace Lantern
{

/// Called from any thread, one message at a time, without a trailing newline. It must not call the device.
using FRTValidationCallback = void (*)(void* User, const char* Message);

/// Out receives one reference to the wrapper, which keeps Inner alive. All objects must then come from the wrapper.
/// Objects not released when the wrapper's last reference goes are reported as leaked.
FRTStatus WrapWithValidation(IRTDevice* Inner, FRTValidationCallback Callback, void* User, IRTDevice** Out);

/// What the wrapper hides; the object itself where it is no wrapper. No reference is added.
IRTRefCounted* GetUnwrapped(IRTRefCounted* Object);

template <class T>
T* Unwrap(T* Object)
{
	return static_cast<T*>(GetUnwrapped(Object));
}

} // namespace Lantern
