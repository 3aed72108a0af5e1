/* SPDX-License-Identifier: Apache-2.0 */
/* What the page gives to the library beside what emcc knows, so that any other missing symbol stops the link. */
mergeInto(LibraryManager.library, { step: function() {} });
