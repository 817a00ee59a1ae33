// Wraps any device and catches wrong use of the RHI. Each fault is one message that names the object and the rule. The call is
// dropped or returns InvalidArgument, so that it never reaches the wrapped device. Errors of the environment (no memory, too
// large for the device, device lost) pass through without a message.
//
// The wrapper follows resource states in the order of submissions.
// - Textures. A barrier's Before must be the texture's state, or None (contents lost). A use needs a state that includes its
//   access. The first barrier of an imported texture says what state it is in.
// - Device and Readback buffers. The rules are those of textures, with three exceptions. A buffer that nothing has used yet may
//   be in any state. Two read-only uses in a row need no barrier. HostRead ends when the CPU has waited: any use may follow it.
//   A memory barrier moves every buffer that is in its Before to its After.
// - Upload buffers. Every submission sees the CPU's writes; reads need no barrier.
// - Scenes. An instance in an Upload buffer must not point at a released geometry, nor at one that no list builds. If one does,
//   BuildScene is dropped. If the instances are written later, the submission is refused.
// - Shader tables. Calls that exclude each other are reported if they meet. After SetPipeline, all that rays can reach must be
//   set again. That is every ray generation, miss and callable record that was ever set, and the first hit record of each
//   instance. If the instances are not known, the wrapper reports only that no hit record at all was set again.
// - Addresses. Uses by shaders through addresses and bindless indices are not seen; the barriers around them are.
#pragma once

#include "LanternRHI/RTInterfaces.h"

namespace Lantern
{

/// Called from any thread, one message at a time, without a trailing newline. It must not call the device.
using FRTValidationCallback = void (*)(void* User, const char* Message);

/// Out receives one reference to the wrapper, which keeps Inner alive. All objects must then come from the wrapper. Objects that
/// are still alive when the wrapper's last reference goes are reported as leaked.
FRTStatus WrapWithValidation(IRTDevice* Inner, FRTValidationCallback Callback, void* User, IRTDevice** Out);

/// Returns the object behind a wrapper, or Object itself if it is no wrapper. Adds no reference.
IRTRefCounted* GetUnwrapped(IRTRefCounted* Object);

/// GetUnwrapped for an interface of the RHI.
template <class T>
T* Unwrap(T* Object)
{
	return static_cast<T*>(GetUnwrapped(Object));
}

} // namespace Lantern
